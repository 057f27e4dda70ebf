#include "host/ocl/device.h"

#include <fmt/format.h>

#include <utility>

#include "host/ocl/platforms.h"

namespace glintmark {
namespace {

// Drivers that keep no times refuse a queue that asks for them.
cl::CommandQueue makeQueue(const Device::Impl& impl) {
  try {
    return {impl.context, impl.device, CL_QUEUE_PROFILING_ENABLE};
  } catch (const cl::Error& error) {
    if (error.err() != CL_INVALID_QUEUE_PROPERTIES) throw;
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

Device::Device(const std::string& selector, TimerChoice timer) : impl_(std::make_unique<Impl>()) {
  FoundPlatforms found = findPlatforms();
  FoundDevice& chosen = found.devices[chooseDevice(found, selector)];
  impl_->info = std::move(chosen.info);
  impl_->device = chosen.device;
  const DeviceInfo& info = impl_->info;
  if (!info.problem.empty())
    throw DeviceError(fmt::format("device '{}' cannot be used: {}", info.name, info.problem));
  impl_->clock = std::make_shared<DeviceClock>(timer, info.timer_resolution_ns, info.name);
  try {
    impl_->context = cl::Context(impl_->device);
    impl_->queue = makeQueue(*impl_);
  } catch (const cl::Error& error) {
    throw DeviceError(openClError(fmt::format("opening device '{}'", info.name), error).what());
  }
}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const {
  return impl_->info;
}

DeviceClock& Device::clock() const {
  return *impl_->clock;
}

}  // namespace glintmark
