// Commands and their events with faults; see fault_list.h.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "tests/faulty_driver/fault_list.h"
#include "tests/faulty_driver/next_call.h"

namespace faulty {
namespace {

// Event times by `clock=`; `start` and `end` are the command's own.
cl_ulong spoilt(cl_profiling_info which, cl_ulong value, cl_ulong start, cl_ulong end) {
  const bool is_end = which == CL_PROFILING_COMMAND_END;
  if (asked("clock", "zero")) return 0;
  if (asked("clock", "still")) return which - CL_PROFILING_COMMAND_QUEUED + 1000000;
  if (asked("clock", "backwards") && is_end) return start - 1000;
  if (asked("clock", "long") && is_end) return start + 10 * (end - start);
  if (asked("clock", "fast") && is_end) return start + 60;
  if (asked("clock", "ticks")) return value / 100;
  if (asked("clock", "garbage") && is_end) {
    static std::atomic<int> count = 0;
    if (++count % 7 == 0) return ~cl_ulong{0} / 3;
  }
  if (const cl_ulong step = numberOf("step")) return value / step * step;
  return value;
}

std::atomic<unsigned long long> launches = 0;

}  // namespace

std::string nameOf(cl_kernel kernel) {
  char name[256] = {};
  clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, nullptr);
  return name;
}

}  // namespace faulty

using namespace faulty;

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

cl_int clSetKernelArg(cl_kernel kernel, cl_uint index, size_t bytes, const void* value) {
  const std::string name = nameOf(kernel);
  if (asked("args", name) && index == 2) return CL_INVALID_ARG_SIZE;
  static std::atomic<int> set = 0;
  if (asked("args_stay", name) && ++set > 20) return CL_SUCCESS;
  return REAL(clSetKernelArg)(kernel, index, bytes, value);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t* offset, const size_t* global, const size_t* local,
                              cl_uint wait_count, const cl_event* wait_list, cl_event* event) {
  misbehave("launching");
  const std::string name = nameOf(kernel);
  if (asked("crash", name)) die();
  if (asked("exit", name)) _exit(7);
  if (asked("exit0", name)) _exit(0);
  while (asked("stall", name)) pause();
  if (asked("resources", name)) return CL_OUT_OF_RESOURCES;
  if (asked("lazy", name)) return CL_MEM_OBJECT_ALLOCATION_FAILURE;
  const unsigned long long launch = ++launches;
  if (numberOf("lost") > 0 && launch > numberOf("lost")) return CL_DEVICE_NOT_AVAILABLE;
  if (numberOf("resources_at") == launch) return CL_OUT_OF_RESOURCES;
  if (const size_t most = numberOf("global"); most > 0 && global && global[0] > most)
    return CL_INVALID_GLOBAL_WORK_SIZE;
  for (const char* limit : {"groups", "launches"})
    if (numberOf(limit) > 0 && local && local[0] > numberOf(limit))
      return CL_INVALID_WORK_GROUP_SIZE;
  if (asked("skip", name)) return clEnqueueMarkerWithWaitList(queue, wait_count, wait_list, event);
  size_t range = global ? global[0] : 0;
  if (asked("half", name) && local) range = std::max<size_t>(range / local[0] / 2, 1) * local[0];
  return REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, &range, local, wait_count,
                                      wait_list, event);
}

cl_int clWaitForEvents(cl_uint count, const cl_event* events) {
  if (asked("wait", "fails")) return CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST;
  if (asked("wait", "early")) return CL_SUCCESS;
  while (asked("wait", "never")) pause();
  return REAL(clWaitForEvents)(count, events);
}

cl_int clGetEventInfo(cl_event event, cl_event_info fact, size_t bytes, void* out, size_t* needed) {
  if (fact == CL_EVENT_COMMAND_EXECUTION_STATUS && asked("event", "failed"))
    return give(cl_int{-9999}, bytes, out, needed);
  if (fact == CL_EVENT_COMMAND_EXECUTION_STATUS && asked("event", "queued"))
    return give(cl_int{CL_QUEUED}, bytes, out, needed);
  return REAL(clGetEventInfo)(event, fact, bytes, out, needed);
}

cl_int clFinish(cl_command_queue queue) {
  if (asked("finish", "fails")) return CL_OUT_OF_RESOURCES;
  if (asked("finish", "early")) return CL_SUCCESS;
  return REAL(clFinish)(queue);
}

}  // extern "C"
