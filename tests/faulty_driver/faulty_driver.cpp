// The calls that GLINTMARK_FAULTS spoils; see fault_list.h.
#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>
#include <dlfcn.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "tests/faulty_driver/fault_list.h"

namespace {

using faulty::asked;
using faulty::numberOf;
using faulty::valueOf;

// The same call further down: the loader's, which programs like mpirun load for themselves only.
template <typename Function>
Function real(Function, const char* name) {
  static void* const loader = dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
  void* const next = dlsym(RTLD_NEXT, name);
  return reinterpret_cast<Function>(next ? next : dlsym(loader, name));
}
#define REAL(call) real(&call, #call)

// Gives `value` as an info call does.
template <typename T>
cl_int give(const T& value, std::size_t bytes, void* out, std::size_t* needed) {
  if (needed) *needed = sizeof value;
  if (!out) return CL_SUCCESS;
  if (bytes < sizeof value) return CL_INVALID_VALUE;
  std::memcpy(out, &value, sizeof value);
  return CL_SUCCESS;
}

const char* refusableName(cl_device_info fact) {
  switch (fact) {
    case CL_DEVICE_HOST_UNIFIED_MEMORY:
      return "unified";
    case CL_DEVICE_MAX_CLOCK_FREQUENCY:
      return "clock";
    case CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT:
    case CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT:
      return "vector";
    case CL_DEVICE_GLOBAL_MEM_CACHE_SIZE:
      return "cache";
    case CL_DEVICE_PROFILING_TIMER_RESOLUTION:
      return "timer";
    case CL_DEVICE_LOCAL_MEM_SIZE:
      return "local";
    default:
      return "";
  }
}

// Event times by `clock=`; `start` and `end` are the command's own.
cl_ulong spoilt(cl_profiling_info which, cl_ulong value, cl_ulong start, cl_ulong end) {
  const bool is_end = which == CL_PROFILING_COMMAND_END;
  if (asked("clock", "zero")) return 0;
  if (asked("clock", "still")) return which - CL_PROFILING_COMMAND_QUEUED + 1000000;
  if (asked("clock", "backwards") && is_end) return start - 1000;
  if (asked("clock", "long") && is_end) return start + 10 * (end - start);
  if (asked("clock", "fast") && is_end) return start + 60;
  if (asked("clock", "ticks")) return value / 100;
  if (const cl_ulong step = numberOf("step")) return value / step * step;
  return value;
}

std::string nameOf(cl_kernel kernel) {
  char name[256] = {};
  clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, nullptr);
  return name;
}

// By the signal of a bad access, whatever handler the driver below has set.
void die() {
  signal(SIGSEGV, SIG_DFL);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGSEGV);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  raise(SIGSEGV);
}

// A platform that is not there.
char ghost_place;
cl_platform_id ghost() {
  return reinterpret_cast<cl_platform_id>(&ghost_place);
}

}  // namespace

extern "C" {

cl_int clGetEventProfilingInfo(cl_event event, cl_profiling_info which, size_t bytes, void* out,
                               size_t* needed) {
  if (asked("clock", "absent")) return CL_PROFILING_INFO_NOT_AVAILABLE;
  const auto call = REAL(clGetEventProfilingInfo);
  const cl_int status = call(event, which, bytes, out, needed);
  if (status != CL_SUCCESS || !out) return status;
  cl_ulong value = 0, start = 0, end = 0;
  std::memcpy(&value, out, sizeof value);
  call(event, CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr);
  call(event, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr);
  return give(spoilt(which, value, start, end), bytes, out, nullptr);
}

cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device,
                                      cl_command_queue_properties properties, cl_int* status) {
  if (asked("exit", "opening")) _exit(7);
  if (asked("abort", "opening")) abort();
  if (asked("clock", "no_queue") && (properties & CL_QUEUE_PROFILING_ENABLE)) {
    if (status) *status = CL_INVALID_QUEUE_PROPERTIES;
    return nullptr;
  }
  return REAL(clCreateCommandQueue)(context, device, properties, status);
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info fact, size_t bytes, void* out,
                       size_t* needed) {
  if (asked("refuse", refusableName(fact))) return CL_INVALID_VALUE;
  const bool is_size = fact == CL_DEVICE_GLOBAL_MEM_SIZE || fact == CL_DEVICE_MAX_MEM_ALLOC_SIZE;
  if (is_size && asked("zero", "memory")) return give(cl_ulong{0}, bytes, out, needed);
  if (const cl_ulong memory = numberOf("memory"); is_size && memory > 0)
    return give(fact == CL_DEVICE_GLOBAL_MEM_SIZE ? memory : memory / 4, bytes, out, needed);
  if (fact == CL_DEVICE_MAX_COMPUTE_UNITS && asked("zero", "units"))
    return give(cl_uint{0}, bytes, out, needed);
  if (fact == CL_DEVICE_MAX_CLOCK_FREQUENCY && asked("zero", "clock"))
    return give(cl_uint{0}, bytes, out, needed);
  if (std::string(refusableName(fact)) == "vector" && asked("zero", "vector"))
    return give(cl_uint{0}, bytes, out, needed);
  if (fact == CL_DEVICE_MAX_WORK_GROUP_SIZE) {
    if (asked("zero", "groups")) return give(size_t{0}, bytes, out, needed);
    if (const size_t most = numberOf("groups")) return give(most, bytes, out, needed);
  }
  return REAL(clGetDeviceInfo)(device, fact, bytes, out, needed);
}

cl_int clGetKernelWorkGroupInfo(cl_kernel kernel, cl_device_id device,
                                cl_kernel_work_group_info fact, size_t bytes, void* out,
                                size_t* needed) {
  if (fact == CL_KERNEL_WORK_GROUP_SIZE) {
    if (asked("zero", "groups")) return CL_INVALID_VALUE;
    if (const size_t most = numberOf("groups")) return give(most, bytes, out, needed);
  }
  return REAL(clGetKernelWorkGroupInfo)(kernel, device, fact, bytes, out, needed);
}

cl_int clGetKernelArgInfo(cl_kernel kernel, cl_uint index, cl_kernel_arg_info fact, size_t bytes,
                          void* out, size_t* needed) {
  if (valueOf("no_arg_info")) return CL_KERNEL_ARG_INFO_NOT_AVAILABLE;
  return REAL(clGetKernelArgInfo)(kernel, index, fact, bytes, out, needed);
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices,
                      const char* options, void(CL_CALLBACK* notify)(cl_program, void*),
                      void* user) {
  if (const auto text = valueOf("build"); text && options && std::strstr(options, text->c_str()))
    die();
  sleep(static_cast<unsigned>(numberOf("build_s")));
  return REAL(clBuildProgram)(program, count, devices, options, notify, user);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t* offset, const size_t* global, const size_t* local,
                              cl_uint wait_count, const cl_event* wait_list, cl_event* event) {
  const std::string name = nameOf(kernel);
  if (asked("crash", name)) die();
  if (asked("exit", name)) _exit(7);
  while (asked("stall", name)) pause();
  if (asked("resources", name)) return CL_OUT_OF_RESOURCES;
  if (const size_t most = numberOf("global"); most > 0 && global && global[0] > most)
    return CL_INVALID_GLOBAL_WORK_SIZE;
  for (const char* limit : {"groups", "launches"})
    if (numberOf(limit) > 0 && local && local[0] > numberOf(limit))
      return CL_INVALID_WORK_GROUP_SIZE;
  return REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, global, local, wait_count,
                                      wait_list, event);
}

cl_int clGetPlatformIDs(cl_uint count, cl_platform_id* platforms, cl_uint* found) {
  if (asked("abort", "looking")) abort();
  if (asked("platforms", "none")) {
    if (found) *found = 0;
    return CL_SUCCESS;
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
