#include "host/fit/ltc_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/ltc.h"

namespace glintmark {
namespace {

// The proposal is this much wider than the lobe, so that weights stay small beside its peak.
constexpr double kWiden = 1.4;

// Point (i, j) of a grid in the unit square, the second axis half a turn. Each column is shifted by
// its own share of a row, so that no two samples of a round lobe fall on one ring: an absolute
// difference has a kink wherever it vanishes at a sample, and rings would add up to large ones.
struct GridPoint {
  double share, angle_rad;
};
GridPoint gridPoint(int i, int j, int rows, int columns) {
  constexpr double kGolden = 0.6180339887498949;
  const double shift = (j + 0.5) * kGolden;
  return {(i + shift - std::floor(shift)) / rows, std::numbers::pi * (j + 0.5) / columns};
}

glm::dvec3 cosineDirection(const GridPoint& p) {
  const double radius = std::sqrt(p.share);
  return {radius * std::cos(p.angle_rad), radius * std::sin(p.angle_rad), std::sqrt(1 - p.share)};
}

glm::dvec3 uniformDirection(const GridPoint& p) {
  const double radius = std::sqrt(1 - p.share * p.share);
  return {radius * std::cos(p.angle_rad), radius * std::sin(p.angle_rad), p.share};
}

class SampleMaker {
 public:
  SampleMaker(reference::Ndf ndf, double alpha, double cos_theta, const glm::dmat3& inverse,
              const LtcSampleCounts& counts)
      : ndf_(ndf),
        alpha_(alpha),
        view_(std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta)), 0, cos_theta),
        inverse_(inverse),
        lobe_count_(static_cast<double>(counts.lobe_radial) * counts.lobe_azimuth),
        uniform_count_(static_cast<double>(counts.hemisphere_radial) * counts.hemisphere_azimuth) {
    samples.whole_sphere = ndf == reference::Ndf::kNormals;
  }

  void add(const glm::dvec3& direction) {
    if (direction.z <= 0 && !samples.whole_sphere) return;
    // Balance heuristic: every sample stands for 1 / (expected density of samples there).
    const double density = lobe_count_ * reference::ltcDensity(inverse_, direction) +
                           uniform_count_ * 0.5 / std::numbers::pi;
    const double weight = 1 / density;
    const double brdf = reference::microfacetTimesCosine(ndf_, direction, view_, alpha_);
    const double view_dot_half = std::sqrt(std::max(0.0, 0.5 * (1 + glm::dot(direction, view_))));
    samples.x.push_back(direction.x);
    samples.y_sq.push_back(direction.y * direction.y);
    samples.z.push_back(direction.z);
    samples.weight.push_back(weight);
    samples.brdf.push_back(brdf);
    samples.albedo += weight * brdf;
    samples.schlick_albedo += weight * brdf * std::pow(1 - std::min(view_dot_half, 1.0), 5);
  }

  LtcSamples samples;

 private:
  reference::Ndf ndf_;
  double alpha_;
  glm::dvec3 view_;
  glm::dmat3 inverse_;
  double lobe_count_, uniform_count_;
};

}  // namespace

LtcSamples makeLtcSamples(reference::Ndf ndf, double alpha, double cos_theta,
                          const LtcLobe& proposal, const LtcSampleCounts& counts) {
  LtcLobe wide = proposal;
  wide.log_width_x += std::log(kWiden);
  wide.log_width_y += std::log(kWiden);
  const glm::dmat3 inverse = ltcInverseMatrix(wide);
  const glm::dmat3 forward = glm::inverse(inverse);
  SampleMaker maker(ndf, alpha, cos_theta, inverse, counts);
  for (int i = 0; i < counts.lobe_radial; ++i) {
    for (int j = 0; j < counts.lobe_azimuth; ++j) {
      maker.add(glm::normalize(
          forward * cosineDirection(gridPoint(i, j, counts.lobe_radial, counts.lobe_azimuth))));
    }
  }
  for (int i = 0; i < counts.hemisphere_radial; ++i) {
    for (int j = 0; j < counts.hemisphere_azimuth; ++j) {
      const glm::dvec3 up =
          uniformDirection(gridPoint(i, j, counts.hemisphere_radial, counts.hemisphere_azimuth));
      maker.add(up);
      if (maker.samples.whole_sphere) maker.add({up.x, up.y, -up.z});
    }
  }
  return std::move(maker.samples);
}

}  // namespace glintmark
