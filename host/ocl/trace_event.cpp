#include "host/core/trace.h"
#include "host/ocl/opencl.h"

namespace glintmark {

void traceEvent(const char* category, const std::string& name, const cl::Event& event,
                std::int64_t host_begin_ns) {
  const DeviceTimes times{.queued = event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>(),
                          .submit = event.getProfilingInfo<CL_PROFILING_COMMAND_SUBMIT>(),
                          .start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>(),
                          .end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>()};
  traceCommand(category, name, times, host_begin_ns, traceNowNs());
}

}  // namespace glintmark
