#include "host/ocl/device_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "host/core/error.h"

namespace glintmark {
namespace {

// Two clocks may drift apart by this much, and be read this far apart.
constexpr double kDrift = 0.01;
constexpr double kSlackNs = 20e3;

// A device's time of this many steps is as good as the wall's; so is any whose step is below what
// the wall adds to every launch.
constexpr double kStepsPerTime = 100;
constexpr double kFineStepNs = 10e3;
// By chance, 8 stamps have a common divisor d with probability of about d^-7.
constexpr std::size_t kStampsForStep = 8;

// No launch is shorter, and one that ends at once may take less than a step.
constexpr std::uint64_t kShortestNs = 50;
constexpr double kShortWallNs = 100e3;

}  // namespace

DeviceClock::DeviceClock(TimerChoice choice, std::uint64_t resolution_ns, std::string device_name)
    : choice_(choice),
      device_name_(std::move(device_name)),
      timer_(choice == TimerChoice::kWall ? Timer::kWall : Timer::kDevice),
      stated_resolution_ns_(resolution_ns) {}

void DeviceClock::onDistrust(std::function<void(const std::string&)> note) {
  const std::lock_guard lock(mutex_);
  note_ = std::move(note);
}

bool DeviceClock::wantsTrial() {
  const std::lock_guard lock(mutex_);
  return timer_ == Timer::kDevice && !std::exchange(tried_, true);
}

Timer DeviceClock::timer() const {
  const std::lock_guard lock(mutex_);
  return timer_;
}

double DeviceClock::resolutionNs() const {
  const std::lock_guard lock(mutex_);
  return resolution();
}

double DeviceClock::resolution() const {
  const std::uint64_t shown = stamps_.size() >= kStampsForStep ? step_ns_ : 0;
  return static_cast<double>(std::max({stated_resolution_ns_, shown, std::uint64_t{1}}));
}

void DeviceClock::learnStep(const EventTimes& times) {
  if (stamps_.size() >= kStampsForStep && step_ns_ == 1) return;
  for (const std::uint64_t stamp : {times.queued, times.submit, times.start, times.end}) {
    step_ns_ = std::gcd(step_ns_, stamp);
    if (stamps_.size() < kStampsForStep) stamps_.insert(stamp);
  }
}

// Why these times cannot be believed, if so; `mutex_` is held.
std::optional<std::string> DeviceClock::faultOf(const EventTimes& times, double wall_ns) {
  if (times.end < times.start)
    return fmt::format("it says that a launch ended {} ns before it began",
                       times.start - times.end);
  const std::uint64_t took = times.end - times.start;
  const bool within_step = took == 0 && times.end != 0 && wall_ns < kShortWallNs;
  if (took < kShortestNs && !within_step)
    return fmt::format("it says that a launch took {} ns", took);
  if (took > 0 && times.start == last_start_ns_ && times.end == last_end_ns_)
    return "it says that two launches took place at the same time";
  last_start_ns_ = times.start;
  last_end_ns_ = times.end;
  const auto took_ns = static_cast<double>(took);
  learnStep(times);
  const double step_ns = resolution();
  // Until enough stamps are seen, their common divisor bounds the step from above.
  const double largest_step_ns = std::max(step_ns, static_cast<double>(step_ns_));
  if (took_ns > wall_ns * (1 + kDrift) + largest_step_ns + kSlackNs)
    return fmt::format("it says {:.4g} ms for a launch that the wall clock saw end after {:.4g} ms",
                       took_ns * 1e-6, wall_ns * 1e-6);
  if (step_ns > kFineStepNs && took_ns < kStepsPerTime * step_ns)
    return fmt::format("its steps of {:.4g} ms are coarse beside a launch of {:.4g} ms",
                       step_ns * 1e-6, took_ns * 1e-6);
  return std::nullopt;
}

double DeviceClock::launchNs(const std::optional<EventTimes>& times, double wall_ns) {
  std::optional<std::string> fault;
  {
    const std::lock_guard lock(mutex_);
    if (timer_ == Timer::kWall) return wall_ns;
    fault = times ? faultOf(*times, wall_ns) : "it does not say when commands ran";
  }
  if (!fault && times->end == times->start) return wall_ns;
  if (!fault) return static_cast<double>(times->end - times->start);
  distrust(*fault);
  return wall_ns;
}

void DeviceClock::distrust(const std::string& reason) {
  std::function<void(const std::string&)> note;
  {
    const std::lock_guard lock(mutex_);
    if (timer_ == Timer::kWall) return;
    if (choice_ == TimerChoice::kDevice)
      throw Error(fmt::format("the clock of '{}' cannot be used: {}; use --timer wall or auto",
                              device_name_, reason));
    timer_ = Timer::kWall;
    note = note_;
  }
  if (note)
    note(
        fmt::format("the clock of '{}' is not used, because {}; kernels are timed by the wall "
                    "clock",
                    device_name_, reason));
}

}  // namespace glintmark
