// Whether the times that a device gives for its commands can be believed.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "host/ocl/device.h"

namespace glintmark {

/// What an event says of its command [ns on the device's clock].
struct EventTimes {
  std::uint64_t queued = 0, submit = 0, start = 0, end = 0;
};

/// Holds every time of a device against the wall clock. Times that are absent, 0, backwards, longer
/// than the wall or coarser than what they time are not used, nor is any later one: figures that
/// two clocks took cannot be compared. Safe from any thread.
class DeviceClock {
 public:
  /// `resolution_ns` is what the device says of its clock, 0 if it does not say.
  DeviceClock(TimerChoice choice, std::uint64_t resolution_ns, std::string device_name);

  /// Called once, as soon as the device's times are given up, with a sentence that says why.
  void onDistrust(std::function<void(const std::string&)> note);

  /// The time [ns] to record for a launch that took `wall_ns` on the host and `times` on the device
  /// (nothing if the device refuses to say). Throws Error if the device's own times were asked for
  /// and cannot be used.
  double launchNs(const std::optional<EventTimes>& times, double wall_ns);

  /// Gives the device's times up for `reason`, a clause: "its times run backwards". Throws Error
  /// if they were asked for. Does nothing where the wall clock is in use.
  void distrust(const std::string& reason);

  /// True at the first call while the device's clock is in use: a single launch may wait for
  /// processors or compilers, so that only launches made for it show a clock that is too slow.
  bool wantsTrial();

  Timer timer() const;
  TimerChoice choice() const { return choice_; }
  /// Step of the device's times, by what it says and by what it has shown [ns]; at least 1.
  double resolutionNs() const;

 private:
  std::optional<std::string> faultOf(const EventTimes& times, double wall_ns);
  void learnStep(const EventTimes& times);
  double resolution() const;

  const TimerChoice choice_;
  const std::string device_name_;
  mutable std::mutex mutex_;
  std::function<void(const std::string&)> note_;
  Timer timer_;
  std::uint64_t stated_resolution_ns_ = 0, step_ns_ = 0;
  std::uint64_t last_start_ns_ = 0, last_end_ns_ = 0;
  std::set<std::uint64_t> stamps_{};  // the first few, to learn the step from
  bool tried_ = false;
};

}  // namespace glintmark
