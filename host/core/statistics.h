// Spread of repeated measurements.
#pragma once
#include <cstddef>
#include <span>

namespace glintmark {

struct Summary {
  std::size_t n = 0;
  double min = 0, median = 0, p95 = 0, stddev = 0;
};

/// Summary of `samples` (not empty): p95 by linear interpolation between order statistics, stddev
/// with n - 1 (0 for one sample). Throws Error for an empty span.
Summary summarize(std::span<const double> samples);

}  // namespace glintmark
