// How often something is timed.
#pragma once
#include <chrono>
#include <initializer_list>
#include <vector>

namespace glintmark {

/// Samples of one quantity over the repetitions.
using Samples = std::vector<double>;

class Repetitions {
 public:
  using Clock = std::chrono::steady_clock;

  /// Exactly `count` times, at least once.
  Repetitions(int count) : least_(count), most_(count) {}  // NOLINT: a number is one
  /// `least` times and until the standard error of every series' median is at most `noise` times
  /// the median (0: whatever it is), but not beyond `until` once there is a sample.
  Repetitions(int least, double noise, Clock::time_point until);

  Repetitions atMost(int most) const;
  /// The least number, times `factor`, rounded up; the rest stays.
  Repetitions scaled(double factor) const;

  /// Is another round due? All series have a sample per round so far.
  bool wantsMore(std::initializer_list<const Samples*> series) const;
  bool wantsMore(const std::vector<Samples>& series) const;

 private:
  // Of a series with that many samples; nothing is said of noise.
  bool mayGoOn(std::size_t rounds) const;
  bool isNoisy(const Samples& samples) const;

  int least_ = 1, most_ = 1;
  double noise_ = 0;
  Clock::time_point until_ = Clock::time_point::max();
};

/// So many rounds are made at most, however noisy the machine.
inline constexpr int kMostRepetitions = 1000;
/// A spread needs as many.
inline constexpr int kLeastNoiseRepetitions = 3;

}  // namespace glintmark
