#include "host/reference/beckmann.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glintmark::reference {
namespace {

constexpr double kLeastMesoVariance = 1e-12;

glm::dvec2 slopeOf(const glm::dvec3& m) {
  return {m.x / m.z, m.y / m.z};
}

}  // namespace

glm::dvec2 mesoRoughness(const glm::dvec2& alpha_g, const glm::dvec2& alpha_l) {
  const glm::dvec2 squared = alpha_g * alpha_g - alpha_l * alpha_l;
  return glm::sqrt(glm::max(squared, glm::dvec2(kLeastMesoVariance)));
}

double slopeDensity(const glm::dvec2& slope, const glm::dvec2& alpha) {
  const glm::dvec2 x = slope / alpha;
  return std::exp(-glm::dot(x, x)) / (std::numbers::pi * alpha.x * alpha.y);
}

double grooveDensity(double slope_v, double alpha_v) {
  const double x = slope_v / alpha_v;
  return std::exp(-x * x) / (std::sqrt(std::numbers::pi) * alpha_v);
}

double ndf(const glm::dvec3& m, const glm::dvec2& alpha) {
  if (m.z <= 0) return 0;
  return slopeDensity(slopeOf(m), alpha) / (m.z * m.z * m.z * m.z);
}

double smithLambda(const glm::dvec3& w, const glm::dvec2& alpha) {
  // alpha tan(theta), with alpha projected on w's azimuth.
  const double alpha_tan = std::hypot(alpha.x * w.x, alpha.y * w.y) / w.z;
  if (alpha_tan <= 0) return 0;
  const double a = 1.0 / alpha_tan;
  const double value = 0.5 * (-std::erfc(a) + std::exp(-a * a) / (a * std::sqrt(std::numbers::pi)));
  return std::max(value, 0.0);  // cancels for large a
}

double maskingShadowing(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha) {
  return 1.0 / (1.0 + smithLambda(i, alpha) + smithLambda(o, alpha));
}

glm::dvec3 schlick(const glm::dvec3& f0, double cosine) {
  return f0 + (glm::dvec3(1.0) - f0) * std::pow(std::clamp(1.0 - cosine, 0.0, 1.0), 5);
}

glm::dvec3 brdfTimesCosine(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha,
                           const glm::dvec3& f0) {
  if (i.z <= 0 || o.z <= 0) return glm::dvec3(0.0);
  const glm::dvec3 m = glm::normalize(i + o);
  return schlick(f0, glm::dot(i, m)) * ndf(m, alpha) * maskingShadowing(i, o, alpha) / (4.0 * o.z);
}

double reflectProbability(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha_g,
                          const glm::dvec2& alpha_l, bool groove) {
  if (i.z <= 0 || o.z <= 0) return 0;
  const glm::dvec2 slope = slopeOf(glm::normalize(i + o));
  const double p = groove ? grooveDensity(slope.y, alpha_g.y) / grooveDensity(0, alpha_l.y)
                          : slopeDensity(slope, alpha_g) / slopeDensity({0, 0}, alpha_l);
  return std::min(p, 1.0);
}

}  // namespace glintmark::reference
