// The loader's own calls and queues, spoilt as fault_list.h has it.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/faulty_driver/fault_list.h"
#include "tests/faulty_driver/next_call.h"

namespace {

using faulty::asked;
using faulty::valueOf;

// A platform that is not there.
char ghost_place;
cl_platform_id ghost() {
  return reinterpret_cast<cl_platform_id>(&ghost_place);
}

}  // namespace

extern "C" {

cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device,
                                      cl_command_queue_properties properties, cl_int* status) {
  if (asked("exit", "opening")) _exit(7);
  if (asked("abort", "opening")) abort();
  if (asked("queue", "refused") || (asked("queue", "plain") && properties != 0)) {
    if (status) *status = CL_INVALID_OPERATION;
    return nullptr;
  }
  if (asked("clock", "no_queue") && (properties & CL_QUEUE_PROFILING_ENABLE)) {
    if (status) *status = CL_INVALID_QUEUE_PROPERTIES;
    return nullptr;
  }
  return REAL(clCreateCommandQueue)(context, device, properties, status);
}

cl_int clGetPlatformIDs(cl_uint count, cl_platform_id* platforms, cl_uint* found) {
  faulty::misbehave("looking");
  if (asked("abort", "looking")) abort();
  if (asked("platforms", "none") || asked("platforms", "absent")) {
    if (found) *found = 0;
    return asked("platforms", "none") ? CL_SUCCESS : -1001;  // CL_PLATFORM_NOT_FOUND_KHR
  }
  if (!asked("platforms", "ghost")) return REAL(clGetPlatformIDs)(count, platforms, found);
  if (platforms) *platforms = ghost();
  cl_uint others = 0;
  const cl_int status = REAL(clGetPlatformIDs)(
      count > 0 ? count - 1 : 0, platforms && count > 1 ? platforms + 1 : nullptr, &others);
  if (found) *found = others + 1;
  return status;
}

cl_int clGetPlatformInfo(cl_platform_id platform, cl_platform_info fact, size_t bytes, void* out,
                         size_t* needed) {
  if (platform == ghost()) return CL_INVALID_PLATFORM;
  return REAL(clGetPlatformInfo)(platform, fact, bytes, out, needed);
}

cl_int clGetDeviceIDs(cl_platform_id platform, cl_device_type type, cl_uint count,
                      cl_device_id* devices, cl_uint* found) {
  if (platform == ghost() || asked("platforms", "broken")) return CL_OUT_OF_HOST_MEMORY;
  if (asked("platforms", "empty")) return CL_DEVICE_NOT_FOUND;
  const auto call = REAL(clGetDeviceIDs);
  if (!valueOf("twins")) return call(platform, type, count, devices, found);
  cl_uint own = 0;
  if (const cl_int status = call(platform, type, 0, nullptr, &own); status != CL_SUCCESS)
    return status;
  std::vector<cl_device_id> ids(own);
  call(platform, type, own, ids.data(), nullptr);
  for (cl_uint i = 0; devices && i < std::min(count, 2 * own); ++i) devices[i] = ids[i % own];
  if (found) *found = 2 * own;
  return CL_SUCCESS;
}

}  // extern "C"
