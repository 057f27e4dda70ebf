#include "host/report/distribution.h"

#include <cmath>
#include <cstddef>

#include "host/core/error.h"

namespace glintmark {

double wassersteinDistance(std::span<const float> a, std::span<const float> b) {
  if (a.empty() || b.empty()) throw Error("no values to take a distance between distributions of");
  // W1 is the mean distance between quantiles. Both quantile functions are steps: walk their edges.
  const auto n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
  double sum = 0, at = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double a_end = static_cast<double>(i + 1) / n, b_end = static_cast<double>(j + 1) / m;
    const double end = std::fmin(a_end, b_end);
    sum += (end - at) * std::abs(static_cast<double>(a[i]) - b[j]);
    at = end;
    if (a_end <= end) ++i;
    if (b_end <= end) ++j;
  }
  return sum;
}

}  // namespace glintmark
