#include "host/reference/light_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/beckmann.h"

namespace glintmark::reference {
namespace {

constexpr double kGolden = 0.6180339887498949;  // lattice generator of the azimuths

// Calls visit(direction) for `samples` directions of equal solid angle.
template <typename Visit>
void forEachDirection(const Cone& light, int samples, Visit&& visit) {
  const glm::dvec3 helper =
      std::abs(light.axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(helper, light.axis));
  const glm::dvec3 other = glm::cross(light.axis, side);
  const double half_sin = std::sin(0.5 * light.half_angle_rad);
  for (int s = 0; s < samples; ++s) {
    // Equal solid angles are equal steps of 1 - cos = 2 sin^2(angle / 2).
    const double one_minus_cos = 2.0 * half_sin * half_sin * (s + 0.5) / samples;
    const double radius = std::sqrt(one_minus_cos * (2.0 - one_minus_cos));
    const double phi = 2.0 * std::numbers::pi * (s * kGolden - std::floor(s * kGolden));
    visit(light.axis * (1.0 - one_minus_cos) +
          (side * std::cos(phi) + other * std::sin(phi)) * radius);
  }
}

// Radiance times solid angle of a cone that gives irradiance 1 on a surface facing its axis:
// pi sin^2 L = 1, and the solid angle is 2 pi (1 - cos).
double powerOf(const Cone& light) {
  return 2.0 / (1.0 + std::cos(light.half_angle_rad));
}

}  // namespace

glm::dvec3 coneRadiance(const Cone& light, const glm::dvec3& o, const glm::dvec2& alpha,
                        const glm::dvec3& f0, int samples) {
  glm::dvec3 sum(0.0);
  forEachDirection(light, samples,
                   [&](const glm::dvec3& i) { sum += brdfTimesCosine(i, o, alpha, f0); });
  return sum * (powerOf(light) / samples);
}

double coneDiffuse(const Cone& light, int samples) {
  double sum = 0;
  forEachDirection(light, samples, [&](const glm::dvec3& i) { sum += std::max(i.z, 0.0); });
  return sum * powerOf(light) / (std::numbers::pi * samples);
}

}  // namespace glintmark::reference
