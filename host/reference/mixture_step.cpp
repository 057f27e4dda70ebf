#include "host/reference/mixture_step.h"

#include <cmath>

namespace glintmark::reference {
namespace {

constexpr double kDimensions = 2;  // of a projected normal: the paper's d

// a g(n; mean, s), but for the factor 2 pi that all lobes share.
double weightedDensity(const NormalLobe& lobe, const glm::dvec2& n) {
  const glm::dvec2 d = n - lobe.mean;
  return lobe.weight / lobe.variance * std::exp(-glm::dot(d, d) / (2 * lobe.variance));
}

// E[z_ij]: the probability that each normal was drawn from each lobe, times its share.
// responsibilities[j][i] of normal j and lobe i.
std::vector<std::vector<double>> expectations(std::span<const NormalLobe> lobes,
                                              std::span<const CoveredNormal> normals) {
  std::vector<std::vector<double>> all;
  for (const CoveredNormal& n : normals) {
    std::vector<double> of_one;
    double sum = 0;
    for (const NormalLobe& lobe : lobes) {
      of_one.push_back(weightedDensity(lobe, n.xy));
      sum += of_one.back();
    }
    for (double& value : of_one) value *= n.share / sum;
    all.push_back(of_one);
  }
  return all;
}

}  // namespace

std::vector<NormalLobe> mixtureStep(std::span<const NormalLobe> lobes,
                                    std::span<const CoveredNormal> normals,
                                    std::span<const std::vector<NormalLobe>> neighbours, double c) {
  const std::vector<std::vector<double>> expected = expectations(lobes, normals);
  double total = 0;  // the paper's M
  for (const CoveredNormal& n : normals) total += n.share;
  std::vector<NormalLobe> next(lobes.begin(), lobes.end());
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    double count = 0, pull = 0;
    glm::dvec2 drawn(0), pulled(0);
    for (std::size_t j = 0; j < normals.size(); ++j) {
      count += expected[j][i];
      drawn += expected[j][i] * normals[j].xy;
    }
    for (const std::vector<NormalLobe>& neighbour : neighbours) {
      pull += neighbour[i].weight;
      pulled += neighbour[i].weight * neighbour[i].mean;
    }
    next[i].weight = count / total;
    if (count + c * pull == 0) continue;
    next[i].mean = (drawn + c * pulled) / (count + c * pull);
    if (count == 0) continue;
    double squares = 0;
    for (std::size_t j = 0; j < normals.size(); ++j) {
      const glm::dvec2 d = normals[j].xy - next[i].mean;
      squares += expected[j][i] * glm::dot(d, d);
    }
    next[i].variance = squares / (kDimensions * count);
  }
  return next;
}

}  // namespace glintmark::reference
