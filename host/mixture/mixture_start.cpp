#include "host/mixture/mixture_start.h"

#include <algorithm>
#include <limits>

namespace glintmark {
namespace {

constexpr int kRounds = 6;
constexpr double kGoldenRatio = 0.6180339887498949;

float squaredDistance(glm::vec2 a, glm::vec2 b) {
  const glm::vec2 d = a - b;
  return glm::dot(d, d);
}

// Each next centre is a normal drawn by its squared distance to the centres so far, as k-means++
// does, but at evenly spread quantiles instead of random ones.
std::vector<glm::vec2> spreadCentres(std::span<const WeightedNormal> normals, int lobes) {
  glm::dvec2 mean(0);
  double weight = 0;
  for (const WeightedNormal& n : normals) {
    mean += static_cast<double>(n.weight) * glm::dvec2(n.xy);
    weight += n.weight;
  }
  std::vector<glm::vec2> centres{glm::vec2(mean / weight)};
  std::vector<float> nearest(normals.size(), std::numeric_limits<float>::max());
  for (int i = 1; i < lobes; ++i) {
    double total = 0;
    for (std::size_t j = 0; j < normals.size(); ++j) {
      nearest[j] = std::min(nearest[j], squaredDistance(normals[j].xy, centres.back()));
      total += static_cast<double>(normals[j].weight) * nearest[j];
    }
    const double quantile = i * kGoldenRatio - static_cast<int>(i * kGoldenRatio);
    double left = quantile * total;
    std::size_t chosen = 0;
    for (; chosen + 1 < normals.size(); ++chosen) {
      left -= static_cast<double>(normals[chosen].weight) * nearest[chosen];
      if (left < 0) break;
    }
    centres.push_back(normals[chosen].xy);
  }
  return centres;
}

int nearestCentre(const std::vector<glm::vec2>& centres, glm::vec2 xy) {
  int best = 0;
  for (int i = 1; i < static_cast<int>(centres.size()); ++i) {
    if (squaredDistance(centres[i], xy) < squaredDistance(centres[best], xy)) best = i;
  }
  return best;
}

}  // namespace

std::vector<NormalLobe> clusterNormals(std::span<const WeightedNormal> normals, int lobes) {
  struct Sums {
    double weight = 0, squares = 0;
    glm::dvec2 xy{0, 0};
  };
  std::vector<glm::vec2> centres = spreadCentres(normals, lobes);
  std::vector<Sums> sums;
  for (int round = 0; round < kRounds; ++round) {
    sums.assign(centres.size(), {});
    for (const WeightedNormal& n : normals) {
      Sums& s = sums[nearestCentre(centres, n.xy)];
      s.weight += n.weight;
      s.xy += static_cast<double>(n.weight) * glm::dvec2(n.xy);
      s.squares += static_cast<double>(n.weight) * glm::dot(glm::dvec2(n.xy), glm::dvec2(n.xy));
    }
    for (std::size_t i = 0; i < centres.size(); ++i) {
      if (sums[i].weight > 0) centres[i] = glm::vec2(sums[i].xy / sums[i].weight);
    }
  }
  double total = 0;
  for (const Sums& s : sums) total += s.weight;
  std::vector<NormalLobe> result;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    NormalLobe lobe{0, centres[i], 0};
    if (sums[i].weight > 0) {
      const glm::dvec2 mean = sums[i].xy / sums[i].weight;
      lobe.weight = static_cast<float>(sums[i].weight / total);
      lobe.variance = static_cast<float>(
          std::max(0.0, 0.5 * (sums[i].squares / sums[i].weight - glm::dot(mean, mean))));
    }
    result.push_back(lobe);
  }
  return result;
}

}  // namespace glintmark
