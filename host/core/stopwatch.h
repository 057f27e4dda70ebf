// Wall time on the steady clock.
#pragma once
#include <chrono>

namespace glintmark {

/// Runs from its construction.
class Stopwatch {
 public:
  double elapsedNs() const {
    return std::chrono::duration<double, std::nano>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace glintmark
