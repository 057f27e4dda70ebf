#include "host/core/trace.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>
#include <tuple>

namespace glintmark {
namespace {

using Clock = std::chrono::steady_clock;

struct Command {
  std::string category, name;
  DeviceTimes times;
  std::int64_t host_begin_ns = 0, host_end_ns = 0;
};

struct Kept {
  std::mutex mutex;
  Clock::time_point start = Clock::now();
  std::vector<HostInterval> host;
  std::vector<Command> commands;
};

Kept& kept() {
  static Kept instance;
  return instance;
}

int threadNumber() {
  static std::atomic<int> count{0};
  thread_local const int number = ++count;
  return number;
}

// Offsets of the clocks [ns] that a command allows, host minus device.
struct OffsetRange {
  std::int64_t low, high;
};

OffsetRange allowedOffsets(const Command& c) {
  return {c.host_begin_ns - static_cast<std::int64_t>(c.times.queued),
          c.host_end_ns - static_cast<std::int64_t>(c.times.end)};
}

}  // namespace

void startTrace() {
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  k.host.clear();
  k.commands.clear();
  k.start = Clock::now();
  trace_detail::is_on = true;
}

void stopTrace() {
  trace_detail::is_on = false;
}

std::int64_t traceNowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - kept().start).count();
}

void TraceScope::begin(const char* category, std::string_view name) {
  category_ = category;
  name_ = name;
  begin_ns_ = traceNowNs();
}

void TraceScope::end() {
  const std::int64_t end_ns = traceNowNs();
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  k.host.push_back({category_, std::move(name_), threadNumber(), begin_ns_, end_ns});
}

void traceCommand(std::string_view category, std::string_view name, const DeviceTimes& times,
                  std::int64_t host_begin_ns, std::int64_t host_end_ns) {
  if (!isTracing()) return;
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  k.commands.push_back(
      {std::string(category), std::string(name), times, host_begin_ns, host_end_ns});
}

std::vector<HostInterval> hostIntervals() {
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  std::vector<HostInterval> intervals = k.host;
  std::ranges::stable_sort(intervals, {},
                           [](const HostInterval& i) { return std::tuple(i.begin_ns, -i.end_ns); });
  return intervals;
}

std::vector<DeviceInterval> deviceIntervals() {
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (k.commands.empty()) return {};
  OffsetRange all{std::numeric_limits<std::int64_t>::min(),
                  std::numeric_limits<std::int64_t>::max()};
  for (const Command& c : k.commands) {
    const OffsetRange own = allowedOffsets(c);
    all = {std::max(all.low, own.low), std::min(all.high, own.high)};
  }
  const std::int64_t common = all.low + (all.high - all.low) / 2;
  std::vector<DeviceInterval> intervals;
  for (const Command& c : k.commands) {
    const OffsetRange own = allowedOffsets(c);
    const bool fits = own.low <= own.high;
    const std::int64_t offset = fits ? std::clamp(common, own.low, own.high) : common;
    const auto start = static_cast<std::int64_t>(c.times.start);
    intervals.push_back({c.category, c.name, start + offset,
                         static_cast<std::int64_t>(c.times.end) + offset,
                         start - static_cast<std::int64_t>(c.times.queued), fits});
  }
  std::ranges::stable_sort(intervals, {}, &DeviceInterval::begin_ns);
  return intervals;
}

}  // namespace glintmark
