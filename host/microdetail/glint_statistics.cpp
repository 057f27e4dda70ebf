#include "host/microdetail/glint_statistics.h"

#include <algorithm>
#include <cmath>

#include "host/core/error.h"

namespace glintmark {
namespace {

void requireAsMany(std::span<const float> before, std::span<const float> after) {
  if (before.empty() || before.size() != after.size())
    throw Error("pixels that changed must be as many as those that did not, at least one");
}

}  // namespace

GlintStatistics glintStatistics(std::span<const float> ratios, int columns,
                                std::span<const float> moved) {
  const auto width = static_cast<std::size_t>(columns);
  if (columns < 1 || ratios.empty() || ratios.size() % width != 0)
    throw Error("pixels of a lattice must be whole rows, at least one");
  const auto n = static_cast<double>(ratios.size());
  GlintStatistics made;
  for (const double ratio : ratios) {
    made.mean += ratio / n;
    made.dark += ratio < kDarkRatio ? 1 / n : 0;
    made.largest = std::max(made.largest, ratio);
  }
  double product = 0, pairs = 0;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const double here = ratios[i] - made.mean;
    made.variance += here * here / n;
    const auto with = [&](std::size_t other) {
      product += here * (ratios[other] - made.mean);
      ++pairs;
    };
    if (i % width + 1 < width) with(i + 1);
    if (i + width < ratios.size()) with(i + width);
  }
  if (!moved.empty()) made.change = meanChange(ratios, moved);
  if (made.variance > 0 && pairs > 0) made.correlation = product / pairs / made.variance;
  return made;
}

double meanChange(std::span<const float> before, std::span<const float> after) {
  requireAsMany(before, after);
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) sum += std::abs(double{after[i]} - before[i]);
  return sum / static_cast<double>(before.size());
}

double correlationOf(std::span<const float> a, std::span<const float> b) {
  requireAsMany(a, b);
  const auto n = static_cast<double>(a.size());
  double mean_a = 0, mean_b = 0, both = 0, of_a = 0, of_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / n;
    mean_b += b[i] / n;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    both += (a[i] - mean_a) * (b[i] - mean_b);
    of_a += (a[i] - mean_a) * (a[i] - mean_a);
    of_b += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return of_a > 0 && of_b > 0 ? both / std::sqrt(of_a * of_b) : 0;
}

std::vector<float> redOf(std::span<const glm::vec3> ratios) {
  std::vector<float> red;
  for (const glm::vec3& ratio : ratios) red.push_back(ratio.r);
  return red;
}

}  // namespace glintmark
