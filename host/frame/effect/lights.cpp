#include "host/frame/effect/lights.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "host/core/float4.h"

namespace glintmark {
namespace {

// Number of taps for a cone, as host/frame/effect/lights.h says.
int tapCount(double half_angle_rad, double one_minus_cos) {
  if (half_angle_rad <= kOneTapHalfAngle_rad) return 1;
  const double per_tap = 1.0 - std::cos(kTapHalfAngle_rad);
  return std::max(kLeastTaps, static_cast<int>(std::ceil(one_minus_cos / per_tap)));
}

// Directions of equal solid angles around `axis`, on a spiral that turns by the golden angle.
void appendTaps(const glm::dvec3& axis, double one_minus_cos, int count,
                std::vector<float4>& taps) {
  const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(helper, axis));
  const glm::dvec3 other = glm::cross(axis, side);
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    // One tap stands in the middle; several in the middle of their rings.
    const double height = count == 1 ? 1.0 : 1.0 - one_minus_cos * (i + 0.5) / count;
    const double radius = std::sqrt(std::max(0.0, 1.0 - height * height));
    const double phi = golden_angle * i;
    const glm::dvec3 d = axis * height + (side * std::cos(phi) + other * std::sin(phi)) * radius;
    taps.push_back(toFloat4(d));
  }
}

}  // namespace

PreparedLights prepareLights(std::span<const ConeLight> lights) {
  PreparedLights prepared;
  for (const ConeLight& light : lights) {
    const glm::dvec3 axis =
        glm::normalize(glm::dvec3(light.direction.x, light.direction.y, light.direction.z));
    const double half_angle = light.direction.w;
    const double half_sin = std::sin(0.5 * half_angle);
    const double one_minus_cos = 2.0 * half_sin * half_sin;
    const int count = tapCount(half_angle, one_minus_cos);

    LightParams params{};
    params.direction = toFloat4(axis, 0.5 * half_angle);
    // Irradiance E = pi sin^2 L on a facing surface; L times solid angle = E 2 / (1 + cos).
    const auto power = [&](float e) { return static_cast<float>(e * 2.0 / (2.0 - one_minus_cos)); };
    params.power = {power(light.irradiance.x), power(light.irradiance.y), power(light.irradiance.z),
                    0};
    params.one_minus_cos = static_cast<float>(one_minus_cos);
    params.cotangent =
        half_angle > 0 ? static_cast<float>((1.0 - one_minus_cos) / std::sin(half_angle)) : 0;
    params.first_tap = static_cast<uint>(prepared.taps.size());
    params.tap_count = static_cast<uint>(count);
    prepared.lights.push_back(params);
    appendTaps(axis, one_minus_cos, count, prepared.taps);
  }
  return prepared;
}

}  // namespace glintmark
