// Which times of a device are believed, launch by launch.
#include "host/ocl/device_clock.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr double kUs = 1e3;

// A clock, what it said when it was given up, and launches on a made-up device.
struct Tried {
  explicit Tried(std::uint64_t resolution_ns = 1, TimerChoice choice = TimerChoice::kAuto)
      : clock(choice, resolution_ns, "made up") {
    clock.onDistrust([this](const std::string& note) { said = note; });
  }
  // What is recorded for a launch from `start` to `end` that took `wall_ns`, by a clock that steps.
  double launch(std::uint64_t start, std::uint64_t end, double wall_ns, std::uint64_t step = 1) {
    const auto stamp = [&](std::uint64_t at) { return at / step * step; };
    return clock.launchNs(
        EventTimes{stamp(start - 3000), stamp(start - 1000), stamp(start), stamp(end)}, wall_ns);
  }

  std::string said;
  DeviceClock clock;
};

TEST(DeviceClock, BelievesTimesWithinTheWalls) {
  Tried tried;
  std::uint64_t at = 1'234'567'891;
  for (int i = 0; i < 20; ++i, at += 1'000'003)
    EXPECT_EQ(tried.launch(at, at + 500'001, 510 * kUs), 500'001.0);
  EXPECT_EQ(tried.clock.timer(), Timer::kDevice) << tried.said;
  EXPECT_EQ(tried.clock.resolutionNs(), 1.0);
}

// Rounded to steps of 0.1 ms, 0.402 ms may read as 0.5: that is the step, not a lie.
TEST(DeviceClock, NamesTheStepOfACoarseClockFromItsFirstLaunchOn) {
  for (std::uint64_t phase = 0; phase < 100'000; phase += 7'001) {
    Tried tried;
    std::uint64_t at = 5'000'000'000 + phase;
    for (int i = 0; i < 8 && tried.said.empty(); ++i, at += 30'011'003 + 1'270'001 * i * i)
      tried.launch(at, at + 402'000, 405 * kUs, 100'000);
    EXPECT_NE(tried.said.find("its steps of 0.1 ms are coarse beside a launch"), std::string::npos)
        << phase << ": " << tried.said;
  }
}

TEST(DeviceClock, TakesACoarseClockForLaunchesThatAreLongBesideItsStep) {
  Tried tried;
  std::uint64_t at = 5'000'000'000;
  for (int i = 0; i < 20; ++i, at += 60'011'003)
    tried.launch(at, at + 50'000'000, 50'010 * kUs, 100'000);
  EXPECT_EQ(tried.clock.timer(), Timer::kDevice) << tried.said;
  EXPECT_EQ(tried.clock.resolutionNs(), 100'000.0);
}

TEST(DeviceClock, ATimeLongerThanTheWallIsALieAtTheFirstLaunch) {
  Tried tried;
  EXPECT_EQ(tried.launch(1'234'567'891, 1'234'567'891 + 900'011, 450 * kUs), 450 * kUs);
  EXPECT_NE(tried.said.find("says 0.9 ms for a launch that the wall clock saw end after 0.45 ms"),
            std::string::npos)
      << tried.said;
  EXPECT_EQ(tried.clock.timer(), Timer::kWall);
}

TEST(DeviceClock, ATimeThatStandsStillIsNeverBelieved) {
  Tried tried;
  for (int i = 0; i < 3; ++i) tried.clock.launchNs(EventTimes{700, 700, 700, 700}, 450 * kUs);
  EXPECT_NE(tried.said.find("took 0 ns"), std::string::npos) << tried.said;
}

TEST(DeviceClock, IsRefusedWhereItWasAskedFor) {
  Tried tried(1, TimerChoice::kDevice);
  EXPECT_THROW(tried.launch(1'234'567'891, 1'234'567'891 + 900'011, 450 * kUs), Error);
}

}  // namespace
}  // namespace glintmark
