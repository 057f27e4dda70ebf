#include "host/fit/anisotropic_samples.h"

#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/fit/sample_grid.h"
#include "host/reference/ltc.h"

namespace glintmark {
namespace {

class AnisotropicSampler {
 public:
  AnisotropicSampler(const AnisotropicView& view, const glm::dmat3& inverse,
                     const AnisotropicSampleCounts& counts)
      : view_(view),
        o_(view.view()),
        wide_alpha_(kWidenProposal * view.alpha),
        inverse_(inverse),
        forward_(1),
        facets_(counts.facet_radial * counts.facet_azimuth),
        lobes_(counts.lobe_radial * counts.lobe_azimuth),
        uniforms_(counts.hemisphere_radial * counts.hemisphere_azimuth) {
    // Rows x and y of M^-1 over the factor make the lobe wider by it.
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 2; ++row) inverse_[column][row] /= kWidenProposal;
    forward_ = glm::inverse(inverse_);
  }

  // All samples of one technique, `make` of a grid point.
  template <typename Make>
  void addGrid(int rows, int columns, const Make& make) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) add(make(gridPoint(i, j, rows, columns, 2 * kPi)));
  }

  glm::dvec3 facetMirror(const GridPoint& p) const {
    const double slope_sq =
        view_.ndf == reference::Ndf::kGgx ? p.share / (1 - p.share) : -std::log1p(-p.share);
    const glm::dvec2 slope =
        wide_alpha_ *
        (std::sqrt(slope_sq) * glm::dvec2(std::cos(p.angle_rad), std::sin(p.angle_rad)));
    const glm::dvec3 m = glm::normalize(view_.fromSurface({slope, 1}));
    return 2 * glm::dot(o_, m) * m - o_;
  }

  glm::dvec3 lobeDirection(const GridPoint& p) const {
    return glm::normalize(forward_ * cosineDirection(p));
  }

  AnisotropicSamples samples;

 private:
  void add(const glm::dvec3& direction) {
    if (direction.z <= 0) return;
    // Every sample stands for 1 / (expected density of samples there).
    double density = lobes_ * reference::ltcDensity(inverse_, direction) + uniforms_ * 0.5 / kPi;
    const glm::dvec3 m = glm::normalize(direction + o_);
    const double o_m = glm::dot(o_, m);
    const double facets = reference::microfacetDensity(view_.ndf, view_.toSurface(m), wide_alpha_);
    if (facets > 0 && o_m > 0) density += facets_ * facets * m.z / (4 * o_m);
    const double weight = 1 / density, brdf = view_.brdf(direction);
    samples.direction.push_back(direction);
    samples.weight.push_back(weight);
    samples.brdf.push_back(brdf);
    samples.albedo += weight * brdf;
    samples.schlick_albedo += weight * brdf * std::pow(1 - std::clamp(o_m, 0.0, 1.0), 5);
  }

  AnisotropicView view_;
  glm::dvec3 o_;
  glm::dvec2 wide_alpha_;
  glm::dmat3 inverse_, forward_;
  double facets_, lobes_, uniforms_;
};

}  // namespace

glm::dvec3 AnisotropicView::view() const {
  return {std::sqrt(std::max(0.0, (1 - cos_theta) * (1 + cos_theta))), 0, cos_theta};
}

glm::dvec3 AnisotropicView::toSurface(const glm::dvec3& d) const {
  const double c = std::cos(phi_rad), s = std::sin(phi_rad);
  return {c * d.x - s * d.y, s * d.x + c * d.y, d.z};
}

glm::dvec3 AnisotropicView::fromSurface(const glm::dvec3& d) const {
  const double c = std::cos(phi_rad), s = std::sin(phi_rad);
  return {c * d.x + s * d.y, -s * d.x + c * d.y, d.z};
}

double AnisotropicView::brdf(const glm::dvec3& direction) const {
  return reference::microfacetTimesCosine(ndf, toSurface(direction), toSurface(view()), alpha);
}

AnisotropicSamples makeAnisotropicSamples(const AnisotropicView& view, const glm::dmat3& inverse,
                                          const AnisotropicSampleCounts& counts) {
  AnisotropicSampler sampler(view, inverse, counts);
  sampler.addGrid(counts.facet_radial, counts.facet_azimuth,
                  [&](const GridPoint& p) { return sampler.facetMirror(p); });
  sampler.addGrid(counts.lobe_radial, counts.lobe_azimuth,
                  [&](const GridPoint& p) { return sampler.lobeDirection(p); });
  sampler.addGrid(counts.hemisphere_radial, counts.hemisphere_azimuth,
                  [&](const GridPoint& p) { return uniformDirection(p); });
  return std::move(sampler.samples);
}

}  // namespace glintmark
