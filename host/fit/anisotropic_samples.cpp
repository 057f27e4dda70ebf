#include "host/fit/anisotropic_samples.h"

#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/reference/ltc.h"

namespace glintmark {
namespace {

// Proposals are this much wider than what they stand for, so that weights stay small beside peaks.
constexpr double kWidenAnisotropic = 1.4;

// Point (i, j) of a grid in the unit square, the second axis a whole turn. Columns are shifted
// against each other, so that no two samples of a round lobe fall on one ring.
struct TurnPoint {
  double share, angle_rad;
};
TurnPoint turnPoint(int i, int j, int rows, int columns) {
  constexpr double kGolden = 0.6180339887498949;
  const double shift = (j + 0.5) * kGolden;
  return {(i + shift - std::floor(shift)) / rows, 2 * kPi * (j + 0.5) / columns};
}

class AnisotropicSampler {
 public:
  AnisotropicSampler(const AnisotropicView& view, const glm::dmat3& inverse,
                     const AnisotropicSampleCounts& counts)
      : view_(view),
        o_(view.view()),
        wide_alpha_(kWidenAnisotropic * view.alpha),
        inverse_(glm::dmat3(glm::dvec3(1), glm::dvec3(1), glm::dvec3(1))),
        facets_(counts.facet_radial * counts.facet_azimuth),
        lobes_(counts.lobe_radial * counts.lobe_azimuth),
        uniforms_(counts.hemisphere_radial * counts.hemisphere_azimuth) {
    // Rows x and y of M^-1 over the factor make the lobe wider by it.
    inverse_ = inverse;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 2; ++row) inverse_[column][row] /= kWidenAnisotropic;
  }

  // All samples of one technique, `make` of a grid point.
  template <typename Make>
  void addGrid(int rows, int columns, const Make& make) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) add(make(turnPoint(i, j, rows, columns)));
  }

  glm::dvec3 facetMirror(const TurnPoint& p) const {
    const double slope_sq =
        view_.ndf == reference::Ndf::kGgx ? p.share / (1 - p.share) : -std::log1p(-p.share);
    const glm::dvec2 slope =
        wide_alpha_ *
        (std::sqrt(slope_sq) * glm::dvec2(std::cos(p.angle_rad), std::sin(p.angle_rad)));
    const glm::dvec3 m = glm::normalize(view_.fromSurface({slope, 1}));
    return 2 * glm::dot(o_, m) * m - o_;
  }

  glm::dvec3 lobeDirection(const TurnPoint& p) const {
    const double radius = std::sqrt(p.share);
    return glm::normalize(glm::inverse(inverse_) * glm::dvec3(radius * std::cos(p.angle_rad),
                                                              radius * std::sin(p.angle_rad),
                                                              std::sqrt(1 - p.share)));
  }

  static glm::dvec3 uniformDirection(const TurnPoint& p) {
    const double radius = std::sqrt(1 - p.share * p.share);
    return {radius * std::cos(p.angle_rad), radius * std::sin(p.angle_rad), p.share};
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
  glm::dmat3 inverse_;
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
                  [&](const TurnPoint& p) { return sampler.facetMirror(p); });
  sampler.addGrid(counts.lobe_radial, counts.lobe_azimuth,
                  [&](const TurnPoint& p) { return sampler.lobeDirection(p); });
  sampler.addGrid(counts.hemisphere_radial, counts.hemisphere_azimuth,
                  [&](const TurnPoint& p) { return sampler.uniformDirection(p); });
  return std::move(sampler.samples);
}

}  // namespace glintmark
