// Progress of work that is mostly short.
#pragma once
#include <string>
#include <utility>

#include "host/core/progress.h"
#include "host/core/stopwatch.h"

namespace glintmark {

/// Says how far a piece of work is, as "[12/100] % of WHAT" on a terminal, once it has taken two
/// seconds.
class LateProgress {
 public:
  explicit LateProgress(std::string what) : what_(std::move(what)) {}

  /// `done` of `total`, both above 0.
  void show(int done, int total) {
    constexpr double kSilent_ns = 2e9;
    if (watch_.elapsedNs() > kSilent_ns)
      progress_.show(static_cast<int>(100.0 * done / total), 100, "% of " + what_);
  }

 private:
  std::string what_;
  Stopwatch watch_;
  Progress progress_{false};
};

}  // namespace glintmark
