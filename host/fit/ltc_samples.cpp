#include "host/fit/ltc_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/fit/sample_grid.h"
#include "host/reference/ltc.h"

namespace glintmark {
namespace {

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
  wide.log_width_x += std::log(kWidenProposal);
  wide.log_width_y += std::log(kWidenProposal);
  const glm::dmat3 inverse = ltcInverseMatrix(wide);
  const glm::dmat3 forward = glm::inverse(inverse);
  SampleMaker maker(ndf, alpha, cos_theta, inverse, counts);
  for (int i = 0; i < counts.lobe_radial; ++i) {
    for (int j = 0; j < counts.lobe_azimuth; ++j) {
      maker.add(glm::normalize(forward *
                               cosineDirection(gridPoint(i, j, counts.lobe_radial,
                                                         counts.lobe_azimuth, std::numbers::pi))));
    }
  }
  for (int i = 0; i < counts.hemisphere_radial; ++i) {
    for (int j = 0; j < counts.hemisphere_azimuth; ++j) {
      const glm::dvec3 up = uniformDirection(
          gridPoint(i, j, counts.hemisphere_radial, counts.hemisphere_azimuth, std::numbers::pi));
      maker.add(up);
      if (maker.samples.whole_sphere) maker.add({up.x, up.y, -up.z});
    }
  }
  return std::move(maker.samples);
}

}  // namespace glintmark
