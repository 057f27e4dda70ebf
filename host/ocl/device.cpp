#include "host/ocl/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "host/ocl/opencl.h"

namespace glintmark {
namespace {

// Names come padded with blanks from some drivers and with a closing NUL from others.
std::string trimmed(const std::string& text) {
  const auto blank = [](unsigned char c) { return std::isspace(c) || c == 0; };
  const auto first = std::find_if_not(text.begin(), text.end(), blank);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), blank).base();
  return first < last ? std::string(first, last) : std::string();
}

std::string lowered(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string typeName(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "GPU";
  if (type & CL_DEVICE_TYPE_CPU) return "CPU";
  return "accelerator";
}

// A CPU wants its vectors written out; a GPU runs one pixel per lane by itself. Some CPU drivers
// report a preferred width of 1 because they vectorise too, hence the native width beside it.
int lanesFor(bool is_cpu, unsigned preferred_width, unsigned native_width) {
  const unsigned width = std::max(preferred_width, native_width);
  if (!is_cpu) return 1;
  return width >= 16 ? 16 : width >= 8 ? 8 : width >= 4 ? 4 : 1;
}

DeviceInfo infoOf(const cl::Platform& platform, const cl::Device& device, int index) {
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  DeviceInfo info;
  info.index = index;
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
  info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.platform_version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
  info.driver_version = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  info.opencl_c_version = trimmed(device.getInfo<CL_DEVICE_OPENCL_C_VERSION>());
  info.type = typeName(type);
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.max_clock_mhz = device.getInfo<CL_DEVICE_MAX_CLOCK_FREQUENCY>();
  info.preferred_float_width = device.getInfo<CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT>();
  info.max_work_group_size = static_cast<unsigned>(device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>());
  info.global_mem_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.max_alloc_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.local_mem_bytes = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
  info.cache_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>();
  info.is_cpu = info.type == "CPU";
  info.host_unified_memory = device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() == CL_TRUE;
  info.correctly_rounded_divide_sqrt =
      (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  info.default_lanes = lanesFor(info.is_cpu, info.preferred_float_width,
                                device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  return info;
}

struct Found {
  cl::Platform platform;
  cl::Device device;
  DeviceInfo info;
};

// A platform without devices, or one whose driver fails to start, must not hide the others.
std::vector<Found> findDevices() {
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return {};  // CL_PLATFORM_NOT_FOUND_KHR: no platform is installed
  }
  std::vector<Found> found;
  for (const cl::Platform& platform : platforms) {
    try {
      std::vector<cl::Device> devices;
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
      for (const cl::Device& device : devices)
        found.push_back(
            {platform, device, infoOf(platform, device, static_cast<int>(found.size()))});
    } catch (const cl::Error&) {
      continue;
    }
  }
  return found;
}

std::size_t choose(const std::vector<Found>& found, const std::string& selector) {
  if (found.empty())
    throw DeviceError(
        "no OpenCL device found; the package pocl-opencl-icd provides one for any processor");
  if (selector.empty()) {
    const auto gpu = std::ranges::find_if(found, [](const Found& f) { return !f.info.is_cpu; });
    return gpu == found.end() ? 0 : static_cast<std::size_t>(gpu - found.begin());
  }

  std::size_t index = 0;
  const char* end = selector.data() + selector.size();
  const auto parsed = std::from_chars(selector.data(), end, index);
  const bool is_number = parsed.ptr == end;
  if (is_number && parsed.ec == std::errc() && index < found.size()) return index;

  std::string known;
  for (const Found& f : found) {
    const bool matches = lowered(f.info.name).find(lowered(selector)) != std::string::npos ||
                         lowered(f.info.platform).find(lowered(selector)) != std::string::npos;
    if (!is_number && matches) return static_cast<std::size_t>(f.info.index);
    known += fmt::format("{}{}: {} ({})", known.empty() ? "" : ", ", f.info.index, f.info.name,
                         f.info.platform);
  }
  throw DeviceError(fmt::format("no OpenCL device matches '{}'; there are {}", selector, known));
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
  std::vector<DeviceInfo> infos;
  for (Found& f : findDevices()) infos.push_back(std::move(f.info));
  return infos;
}

Device::Device(const std::string& selector) : impl_(std::make_unique<Impl>()) {
  std::vector<Found> found = findDevices();
  Found& chosen = found[choose(found, selector)];
  impl_->info = std::move(chosen.info);
  impl_->device = chosen.device;
  try {
    impl_->context = cl::Context(impl_->device);
    impl_->queue = cl::CommandQueue(impl_->context, impl_->device, CL_QUEUE_PROFILING_ENABLE);
  } catch (const cl::Error& error) {
    throw DeviceError(
        openClError(fmt::format("opening device '{}'", impl_->info.name), error).what());
  }
}

Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;

const DeviceInfo& Device::info() const {
  return impl_->info;
}

}  // namespace glintmark
