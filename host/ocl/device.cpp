#include "host/ocl/device.h"

#include <fmt/format.h>

#include <set>
#include <utility>
#include <vector>

#include "host/ocl/driver_death.h"
#include "host/ocl/driver_visit.h"
#include "host/ocl/platforms.h"

namespace glintmark {
namespace {

// Drivers that keep no times refuse a queue that asks for them.
cl::CommandQueue makeQueue(const Device::Impl& impl) {
  try {
    return {impl.context, impl.device, CL_QUEUE_PROFILING_ENABLE};
  } catch (const cl::Error& error) {
    const std::set<cl_int> refusals = {CL_INVALID_QUEUE_PROPERTIES, CL_INVALID_OPERATION,
                                       CL_INVALID_VALUE};
    if (!refusals.contains(error.err())) throw;
    return {impl.context, impl.device};
  }
}

}  // namespace

const char* timerName(Timer timer) {
  return timer == Timer::kDevice ? "device" : "wall";
}

PlatformList listPlatforms() {
  PlatformList list = findPlatforms().list;
  list.broken_drivers = brokenDrivers();
  return list;
}

std::vector<DeviceInfo> listDevices() {
  std::vector<DeviceInfo> infos;
  for (FoundDevice& found : findPlatforms().devices) infos.push_back(std::move(found.info));
  return infos;
}

std::vector<int> devicesLike(const std::string& selector) {
  const FoundPlatforms found = findPlatforms();
  const DeviceInfo& chosen = found.devices[chooseDevice(found, selector)].info;
  std::vector<int> indices = {chosen.index};
  for (const FoundDevice& other : found.devices) {
    const DeviceInfo& info = other.info;
    if (info.index != chosen.index && info.problem.empty() && info.name == chosen.name &&
        info.platform == chosen.platform)
      indices.push_back(info.index);
  }
  return indices;
}

Device::Device(const std::string& selector, TimerChoice timer) : impl_(std::make_unique<Impl>()) {
  FoundPlatforms found = findPlatforms();
  FoundDevice& chosen = found.devices[chooseDevice(found, selector)];
  impl_->info = std::move(chosen.info);
  impl_->device = chosen.device;
  const DeviceInfo& info = impl_->info;
  if (!info.problem.empty())
    throw DeviceError(fmt::format("device '{}' cannot be used: {}", info.name, info.problem));
  open(timer);
}

void Device::open(TimerChoice timer) {
  const DeviceInfo& info = impl_->info;
  const DriverVisit visit(fmt::format("opening '{}'", info.name), kLaunchPatience);
  const DriverDeath death;
  impl_->clock = std::make_shared<DeviceClock>(timer, info.timer_resolution_ns, info.name);
  try {
    impl_->context = cl::Context(impl_->device);
    impl_->queue = makeQueue(*impl_);
  } catch (const cl::Error& error) {
    throw DeviceError(openClError(fmt::format("opening device '{}'", info.name), error).what());
  }
}

Device Device::part(unsigned compute_units) const {
  const DeviceInfo& whole = impl_->info;
  const auto refused = [&](const std::string& why) {
    return DeviceError(fmt::format("device '{}' gives no part of {} of its {} compute units: {}",
                                   whole.name, compute_units, whole.compute_units, why));
  };
  if (compute_units < 1 || compute_units > whole.compute_units) throw refused("it has not so many");
  Device part(std::make_unique<Impl>());
  part.impl_->info = whole;
  std::vector<cl::Device> parts;
  const cl_device_partition_property counts[] = {
      CL_DEVICE_PARTITION_BY_COUNTS, static_cast<cl_device_partition_property>(compute_units),
      CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
  try {
    cl::Device(impl_->device).createSubDevices(counts, &parts);
    if (!parts.empty())
      part.impl_->info.compute_units = parts.front().getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  } catch (const cl::Error& error) {
    throw refused(openClError("clCreateSubDevices", error).what());
  }
  if (parts.empty()) throw refused("the driver returned none");
  part.impl_->device = parts.front();
  part.open(impl_->clock->choice());
  return part;
}

Device::Device(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Device::~Device() {
  if (!impl_) return;
  const DriverVisit visit(fmt::format("closing '{}'", impl_->info.name), kLaunchPatience);
  impl_.reset();
}

Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const {
  return impl_->info;
}

DeviceClock& Device::clock() const {
  return *impl_->clock;
}

}  // namespace glintmark
