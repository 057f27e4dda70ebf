// Intervals of a run, of the host's threads and of the device's queue, on the host's clock. While
// tracing is off, a scope costs one relaxed load and keeps nothing.
#pragma once
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glintmark {

namespace trace_detail {
inline std::atomic<bool> is_on{false};
}

inline bool isTracing() {
  return trace_detail::is_on.load(std::memory_order_relaxed);
}

/// Forgets what was kept, and keeps intervals from now on.
void startTrace();
/// Keeps no more; what was kept stays.
void stopTrace();

/// Nanoseconds on the steady clock since startTrace(); may be called while tracing is off.
std::int64_t traceNowNs();

/// One interval of a host thread. Threads are numbered from 1 in the order they first appear.
struct HostInterval {
  std::string category, name;
  int thread = 1;
  std::int64_t begin_ns = 0, end_ns = 0;
};

/// Keeps the interval from its construction to its destruction.
class TraceScope {
 public:
  TraceScope(const char* category, std::string_view name) {
    if (isTracing()) begin(category, name);
  }
  ~TraceScope() {
    if (begin_ns_ >= 0) end();
  }
  TraceScope(const TraceScope&) = delete;
  TraceScope& operator=(const TraceScope&) = delete;

 private:
  void begin(const char* category, std::string_view name);
  void end();

  std::int64_t begin_ns_ = -1;  // -1: tracing was off
  const char* category_ = "";
  std::string name_;
};

/// A command's profiling times [ns] on the device's own clock.
struct DeviceTimes {
  std::uint64_t queued = 0, submit = 0, start = 0, end = 0;
};

/// Keeps one command of the device's queue. The host enqueued it after `host_begin_ns` and knew of
/// its end before `host_end_ns`, both by traceNowNs().
void traceCommand(std::string_view category, std::string_view name, const DeviceTimes& times,
                  std::int64_t host_begin_ns, std::int64_t host_end_ns);

/// A command of the device on the host's clock.
struct DeviceInterval {
  std::string category, name;
  std::int64_t begin_ns = 0, end_ns = 0;
  std::int64_t queued_ns = 0;  // enqueue to start
  bool fits = true;            // the host's clock allows it where it stands
};

/// By begin, longer ones first where equal: an interval comes after those that enclose it.
std::vector<HostInterval> hostIntervals();

/// In the order of their begin. The two clocks differ by an offset that each command bounds: it can
/// have been queued no earlier, and have ended no later, than the host says. The offset is taken
/// from the middle of what all commands allow. Where they contradict each other, because the clocks
/// drift, each command is moved by the least that its own bounds ask for.
std::vector<DeviceInterval> deviceIntervals();

}  // namespace glintmark
