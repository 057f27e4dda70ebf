#include "host/microdetail/glint_statistics.h"

#include <algorithm>
#include <cmath>

#include "host/core/error.h"

namespace glintmark {

GlintStatistics glintStatistics(std::span<const float> ratios, int columns,
                                std::span<const float> moved) {
  const auto width = static_cast<std::size_t>(columns);
  if (columns < 1 || ratios.empty() || ratios.size() % width != 0)
    throw Error("pixels of a lattice must be whole rows, at least one");
  if (!moved.empty() && moved.size() != ratios.size())
    throw Error("pixels that moved must be as many as those that did not");
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
    if (!moved.empty()) made.change += std::abs(double{moved[i]} - ratios[i]) / n;
  }
  if (made.variance > 0 && pairs > 0) made.correlation = product / pairs / made.variance;
  return made;
}

std::vector<float> redOf(std::span<const glm::vec3> ratios) {
  std::vector<float> red;
  for (const glm::vec3& ratio : ratios) red.push_back(ratio.r);
  return red;
}

}  // namespace glintmark
