#include "host/fit/ltc_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/ltc.h"

namespace glintmark {
namespace {

// The proposal is this much wider than the lobe, so that weights stay small beside its peak.
constexpr double kWiden = 1.4;

// Grid point (i, j) of the half disc under a hemisphere.
glm::dvec3 cosineDirection(int i, int j, int radial, int azimuth) {
  const double radius_sq = (i + 0.5) / radial;
  const double angle = std::numbers::pi * (j + 0.5) / azimuth;
  const double radius = std::sqrt(radius_sq);
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius_sq)};
}

glm::dvec3 uniformDirection(int i, int j, int radial, int azimuth) {
  const double z = (i + 0.5) / radial;
  const double angle = std::numbers::pi * (j + 0.5) / azimuth;
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
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
        uniform_count_(static_cast<double>(counts.hemisphere_radial) * counts.hemisphere_azimuth) {}

  void add(const glm::dvec3& direction) {
    if (direction.z <= 0) return;
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
      maker.add(
          glm::normalize(forward * cosineDirection(i, j, counts.lobe_radial, counts.lobe_azimuth)));
    }
  }
  for (int i = 0; i < counts.hemisphere_radial; ++i) {
    for (int j = 0; j < counts.hemisphere_azimuth; ++j) {
      maker.add(uniformDirection(i, j, counts.hemisphere_radial, counts.hemisphere_azimuth));
    }
  }
  return std::move(maker.samples);
}

}  // namespace glintmark
