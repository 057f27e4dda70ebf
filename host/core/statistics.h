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

/// Standard error of the median of `n` > 0 roughly normal samples: sqrt(pi / 2) stddev / sqrt(n).
double medianStandardError(const Summary& summary);

}  // namespace glintmark
