#include "host/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/core/error.h"

namespace glintmark {
namespace {

// Linear interpolation between order statistics at q in [0, 1].
double quantile(const std::vector<double>& sorted, double q) {
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

}  // namespace

Summary summarize(std::span<const double> samples) {
  if (samples.empty()) throw Error("cannot summarize an empty set of measurements");
  std::vector<double> sorted(samples.begin(), samples.end());
  std::ranges::sort(sorted);

  double mean = 0;
  for (double s : sorted) mean += s / static_cast<double>(sorted.size());
  double squares = 0;
  for (double s : sorted) squares += (s - mean) * (s - mean);

  Summary summary;
  summary.n = sorted.size();
  summary.min = sorted.front();
  summary.median = quantile(sorted, 0.5);
  summary.p95 = quantile(sorted, 0.95);
  summary.stddev =
      sorted.size() > 1 ? std::sqrt(squares / static_cast<double>(sorted.size() - 1)) : 0;
  return summary;
}

double medianStandardError(const Summary& summary) {
  return std::sqrt(std::numbers::pi / 2 / static_cast<double>(summary.n)) * summary.stddev;
}

}  // namespace glintmark
