// What drivers say of their devices, and what they refuse to say.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/ocl/driver_text.h"
#include "host/ocl/opencl.h"
#include "host/ocl/platforms.h"

namespace glintmark {
namespace {

// No device has more of it.
constexpr double kMostUnits = 1 << 20, kMostMhz = 1e5;
constexpr double kMostMemoryBytes = 1e17, kMostCacheBytes = 16e9, kMostStepNs = 1e9;

// A CPU wants its vectors written out; a GPU runs one pixel per lane by itself. Some CPU drivers
// report a preferred width of 1 because they vectorise too, hence the native width beside it.
int lanesFor(bool is_cpu, unsigned preferred_width, unsigned native_width) {
  const unsigned width = std::max(preferred_width, native_width);
  if (!is_cpu) return 1;
  return width >= 16 ? 16 : width >= 8 ? 8 : width >= 4 ? 4 : 1;
}

std::string typeName(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "GPU";
  if (type & CL_DEVICE_TYPE_CPU) return "CPU";
  return "accelerator";
}

// Asks for one fact after the other, keeps the names of those that are refused.
class Facts {
 public:
  Facts(cl_device_id device, std::vector<std::string>& refused)
      : device_(device), refused_(refused) {}

  // 0 also for what is above `most`: drivers that do not know say -1, or fill half of the bytes.
  template <typename T>
  T number(cl_device_info fact, const char* name, double most = 0) {
    T value{};
    if (clGetDeviceInfo(device_, fact, sizeof value, &value, nullptr) == CL_SUCCESS &&
        (most == 0 || static_cast<double>(value) <= most))
      return value;
    refused_.emplace_back(name);
    return T{};
  }

  std::string text(cl_device_info fact, const char* name) {
    std::size_t bytes = 0;
    if (clGetDeviceInfo(device_, fact, 0, nullptr, &bytes) == CL_SUCCESS) {
      std::string value(bytes, '\0');
      if (clGetDeviceInfo(device_, fact, bytes, value.data(), nullptr) == CL_SUCCESS)
        return shownText(value);
    }
    refused_.emplace_back(name);
    return "";
  }

  // Work-items of a group: the limit of all dimensions together, and of the first.
  std::size_t groupLimit() {
    const auto all = number<std::size_t>(CL_DEVICE_MAX_WORK_GROUP_SIZE, "MAX_WORK_GROUP_SIZE");
    std::size_t sizes[8] = {};
    const bool given = clGetDeviceInfo(device_, CL_DEVICE_MAX_WORK_ITEM_SIZES, sizeof sizes, sizes,
                                       nullptr) == CL_SUCCESS;
    if (!given || sizes[0] == 0) return all;
    return all == 0 ? sizes[0] : std::min(all, sizes[0]);
  }

  // Does the driver answer, and with no?
  bool denies(cl_device_info fact) const {
    cl_bool yes = CL_TRUE;
    return clGetDeviceInfo(device_, fact, sizeof yes, &yes, nullptr) == CL_SUCCESS &&
           yes == CL_FALSE;
  }

 private:
  cl_device_id device_;
  std::vector<std::string>& refused_;
};

}  // namespace

std::string platformText(const cl::Platform& platform, cl_platform_info fact) {
  std::size_t bytes = 0;
  if (clGetPlatformInfo(platform(), fact, 0, nullptr, &bytes) != CL_SUCCESS) return "";
  std::string text(bytes, '\0');
  if (clGetPlatformInfo(platform(), fact, bytes, text.data(), nullptr) != CL_SUCCESS) return "";
  return shownText(text);
}

DeviceInfo describeDevice(const PlatformInfo& platform, const cl::Device& device, int index) {
  DeviceInfo info;
  Facts facts(device(), info.refused);
#define GM_NUMBER(type, fact) facts.number<type>(CL_DEVICE_##fact, #fact)
#define GM_AT_MOST(type, fact, most) facts.number<type>(CL_DEVICE_##fact, #fact, most)
#define GM_TEXT(fact) facts.text(CL_DEVICE_##fact, #fact)
  info.index = index;
  info.platform = platform.name;
  info.platform_version = platform.version;
  info.name = GM_TEXT(NAME);
  info.vendor = GM_TEXT(VENDOR);
  info.driver_version = facts.text(CL_DRIVER_VERSION, "DRIVER_VERSION");
  info.opencl_c_version = GM_TEXT(OPENCL_C_VERSION);
  info.type = typeName(GM_NUMBER(cl_device_type, TYPE));
  info.is_cpu = info.type == "CPU";
  info.compute_units = GM_AT_MOST(cl_uint, MAX_COMPUTE_UNITS, kMostUnits);
  info.max_clock_mhz = GM_AT_MOST(cl_uint, MAX_CLOCK_FREQUENCY, kMostMhz);
  info.preferred_float_width = GM_NUMBER(cl_uint, PREFERRED_VECTOR_WIDTH_FLOAT);
  info.max_work_group_size = facts.groupLimit();
  info.global_mem_bytes = GM_AT_MOST(cl_ulong, GLOBAL_MEM_SIZE, kMostMemoryBytes);
  info.max_alloc_bytes = GM_AT_MOST(cl_ulong, MAX_MEM_ALLOC_SIZE, kMostMemoryBytes);
  info.local_mem_bytes = GM_AT_MOST(cl_ulong, LOCAL_MEM_SIZE, kMostMemoryBytes);
  info.cache_bytes = GM_AT_MOST(cl_ulong, GLOBAL_MEM_CACHE_SIZE, kMostCacheBytes);
  info.timer_resolution_ns = GM_AT_MOST(std::size_t, PROFILING_TIMER_RESOLUTION, kMostStepNs);
  info.host_unified_memory = GM_NUMBER(cl_bool, HOST_UNIFIED_MEMORY) == CL_TRUE;
  info.correctly_rounded_divide_sqrt =
      (GM_NUMBER(cl_device_fp_config, SINGLE_FP_CONFIG) & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  info.default_lanes = lanesFor(info.is_cpu, info.preferred_float_width,
                                GM_NUMBER(cl_uint, NATIVE_VECTOR_WIDTH_FLOAT));
#undef GM_NUMBER
#undef GM_AT_MOST
#undef GM_TEXT
  if (facts.denies(CL_DEVICE_AVAILABLE)) info.problem = "its driver says that it is not available";
  if (facts.denies(CL_DEVICE_COMPILER_AVAILABLE)) info.problem = "its driver has no compiler";
  if (info.name.empty()) info.name = "(no name)";
  return info;
}

}  // namespace glintmark
