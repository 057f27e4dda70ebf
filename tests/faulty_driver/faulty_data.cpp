// Buffers whose bytes do not arrive; see fault_list.h.
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/faulty_driver/fault_list.h"
#include "tests/faulty_driver/next_call.h"

namespace faulty {
namespace {

// What `data=` makes of floats that were read.
void spoil(void* out, std::size_t bytes) {
  const std::size_t count = bytes / sizeof(float);
  auto* values = static_cast<char*>(out);
  static std::atomic<std::uint32_t> noise = 1;
  for (std::size_t i = 0; i < count; ++i) {
    float value = 0;
    std::memcpy(&value, values + 4 * i, 4);
    if (asked("data", "half") && i >= count / 2) value = 0;
    if (asked("data", "odd") && i % 2 == 1) value = 0;
    if (asked("data", "nan") && i % 97 == 5) value = std::numeric_limits<float>::quiet_NaN();
    if (asked("data", "ulps") && std::isfinite(value)) value *= 1 + 3e-7f;
    if (asked("data", "percent") && std::isfinite(value)) value *= 1.01f;
    if (asked("data", "double") && std::isfinite(value)) value *= 2;
    if (asked("data", "black")) value = 0;
    if (asked("data", "noise")) {
      noise = noise * 1664525u + 1013904223u;
      if (std::isfinite(value))
        value *= 1 + 0.2f * (static_cast<float>(noise >> 8) / 16777216 - 0.5f);
    }
    std::memcpy(values + 4 * i, &value, 4);
  }
}

std::size_t least() {
  return numberOf("from") > 0 ? numberOf("from") : 0;
}

}  // namespace
}  // namespace faulty

using namespace faulty;

extern "C" {

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void* host,
                      cl_int* status) {
  if (const size_t most = numberOf("allocates"); most > 0 && bytes > most) {
    if (status) *status = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return nullptr;
  }
  if (valueOf("no_host_memory") && (flags & CL_MEM_USE_HOST_PTR) != 0) {
    if (status) *status = CL_INVALID_HOST_PTR;
    return nullptr;
  }
  return REAL(clCreateBuffer)(context, flags, bytes, host, status);
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                           size_t bytes, void* out, cl_uint wait_count, const cl_event* wait_list,
                           cl_event* event) {
  misbehave("reading");
  const auto call = REAL(clEnqueueReadBuffer);
  const bool small = bytes < least();
  if (asked("read", "fails") && !small) return CL_OUT_OF_RESOURCES;
  if (asked("read", "nothing") && !small)
    return clEnqueueMarkerWithWaitList(queue, wait_count, wait_list, event);
  size_t read = bytes;
  if (asked("read", "short") && !small) read = bytes > 1 ? bytes / 2 : bytes;
  const cl_int status =
      call(queue, buffer, blocking, offset, read, out, wait_count, wait_list, event);
  if (valueOf("data") && !small && status == CL_SUCCESS) spoil(out, bytes);
  return status;
}

cl_int clEnqueueWriteBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                            size_t bytes, const void* source, cl_uint wait_count,
                            const cl_event* wait_list, cl_event* event) {
  const auto call = REAL(clEnqueueWriteBuffer);
  if (bytes >= least()) {
    if (asked("write", "fails")) return CL_OUT_OF_RESOURCES;
    if (asked("write", "lazy")) return CL_MEM_OBJECT_ALLOCATION_FAILURE;
    if (asked("write", "nothing"))
      return clEnqueueMarkerWithWaitList(queue, wait_count, wait_list, event);
    if (asked("write", "short") && bytes > 1) bytes /= 2;
  }
  return call(queue, buffer, blocking, offset, bytes, source, wait_count, wait_list, event);
}

cl_int clEnqueueFillBuffer(cl_command_queue queue, cl_mem buffer, const void* pattern,
                           size_t pattern_bytes, size_t offset, size_t bytes, cl_uint wait_count,
                           const cl_event* wait_list, cl_event* event) {
  if (asked("fill", "fails")) return CL_INVALID_VALUE;
  if (asked("fill", "nothing"))
    return clEnqueueMarkerWithWaitList(queue, wait_count, wait_list, event);
  return REAL(clEnqueueFillBuffer)(queue, buffer, pattern, pattern_bytes, offset, bytes, wait_count,
                                   wait_list, event);
}

}  // extern "C"
