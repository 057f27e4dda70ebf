#include "host/core/trace.h"
#include "host/ocl/opencl.h"

namespace glintmark {

std::optional<EventTimes> eventTimes(const cl::Event& event) {
  try {
    return EventTimes{.queued = event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>(),
                      .submit = event.getProfilingInfo<CL_PROFILING_COMMAND_SUBMIT>(),
                      .start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>(),
                      .end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>()};
  } catch (const cl::Error&) {
    return std::nullopt;
  }
}

void traceEvent(const char* category, const std::string& name, const cl::Event& event,
                std::int64_t host_begin_ns, const DeviceClock& clock) {
  if (clock.timer() == Timer::kWall) return;
  const std::optional<EventTimes> times = eventTimes(event);
  if (!times || times->start < times->queued || times->end < times->start) return;
  traceCommand(
      category, name,
      {.queued = times->queued, .submit = times->submit, .start = times->start, .end = times->end},
      host_begin_ns, traceNowNs());
}

}  // namespace glintmark
