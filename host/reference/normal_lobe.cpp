#include "host/reference/normal_lobe.h"

#include <algorithm>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>

#include "host/core/angles.h"

namespace glintmark::reference {
namespace {

// Smith's Lambda of Beckmann, exact.
double smithLambda(double cosine, double alpha) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  if (sine == 0) return 0;
  const double a = cosine / (alpha * sine);
  return 0.5 * (std::erf(a) - 1) + std::exp(-a * a) / (2 * a * std::sqrt(kPi));
}

// Exponent of a Gaussian of Beckmann roughness squared `a1` along `d` and `a2` across.
double exponent(const glm::dvec2& offset, const glm::dvec2& d, double a1, double a2) {
  const double along = glm::dot(offset, d), across = d.x * offset.y - d.y * offset.x;
  return along * along / a1 + across * across / a2;
}

}  // namespace

NormalLobe lobeFromMoments(const glm::dvec4& moments) {
  if (!(moments.x > 0)) return {};
  const glm::dvec2 mean(moments.y / moments.x, moments.z / moments.x);
  return {moments.x, mean, std::max(0.0, 0.5 * (moments.w / moments.x - glm::dot(mean, mean)))};
}

double massOnDisk(const NormalLobe& lobe) {
  if (!(lobe.variance > 1e-7)) return 1;
  const double tilt_sq = glm::dot(lobe.mean, lobe.mean);
  const boost::math::non_central_chi_squared squares(2, std::max(tilt_sq / lobe.variance, 1e-12));
  return boost::math::cdf(squares, 1 / lobe.variance);
}

glm::dvec3 meanNormal(const NormalLobe& lobe) {
  const double tilt_sq = glm::dot(lobe.mean, lobe.mean), z_sq = std::max(0.0, 1 - tilt_sq);
  const double square = std::max(z_sq - 2 * lobe.variance, z_sq / 64);
  return {lobe.mean, std::sqrt(square) / (1 + 0.5 * tilt_sq * lobe.variance / (z_sq * z_sq))};
}

LobeLight shadeLobe(const NormalLobe& lobe, const glm::dvec3& light, const glm::dvec3& view,
                    double alpha) {
  const double tilt = glm::length(lobe.mean);
  const double z = std::sqrt(std::max(0.0, 1 - tilt * tilt));
  const glm::dvec3 m(lobe.mean, z);
  const glm::dvec3 h = glm::normalize(light + view);
  const glm::dvec2 d = tilt > 0 ? lobe.mean / tilt : glm::dvec2(1, 0);
  const double across = alpha * alpha + 2 * lobe.variance;
  const double along = alpha * alpha + 2 * lobe.variance / (z * z);
  const double share = 2 * lobe.variance / across;

  // Slopes around m: tangent vectors along the tilt (upwards) and across it.
  const glm::dvec3 up(d * z, -tilt), side(-d.y, d.x, 0);
  const double cosine = std::max(glm::dot(m, h), 1e-3);
  const glm::dvec2 slope(glm::dot(up, h) / cosine, glm::dot(side, h) / cosine);
  const double of_slopes = exponent(slope, {1, 0}, along, across);
  const double of_normals = exponent(glm::dvec2(h) - lobe.mean, d, along * z * z, across);
  const double scale = (1 - share) / std::pow(cosine, 4) + share * std::max(h.z, 0.0) / z;
  const double density = std::exp(-((1 - share) * of_slopes + share * of_normals)) * scale /
                         (kPi * std::sqrt(along * across));

  const glm::dvec3 n = glm::normalize((1 - share) * m + share * h);
  const double light_z = glm::dot(n, light), view_z = glm::dot(n, view);
  LobeLight result;
  if (light_z > 0 && view_z > 0) {
    const double masking = 1 / (1 + smithLambda(light_z, alpha) + smithLambda(view_z, alpha));
    result.specular = lobe.weight * density * masking / (4 * view_z * massOnDisk(lobe));
  }
  result.cosine = lobe.weight * std::max(0.0, glm::dot(meanNormal(lobe), light));
  return result;
}

}  // namespace glintmark::reference
