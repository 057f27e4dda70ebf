#include "host/frame/effect/lights.h"

#include <cmath>

#include "host/core/float4.h"
#include "host/frame/effect/light_tree.h"

namespace glintmark {
namespace {

LightParams prepareLight(const ConeLight& light) {
  const LightCone cone = coneOf(light);
  LightParams params{};
  params.direction = toFloat4(cone.axis, 0.5 * cone.half_angle_rad);
  // Irradiance E = pi sin^2 L on a facing surface; L times solid angle = E 2 / (1 + cos).
  const auto power = [&](float e) {
    return static_cast<float>(e * 2.0 / (2.0 - cone.one_minus_cos));
  };
  params.power = {power(light.irradiance.x), power(light.irradiance.y), power(light.irradiance.z),
                  0};
  params.skip = 1;
  params.one_minus_cos = static_cast<float>(cone.one_minus_cos);
  if (cone.half_angle_rad > 0)
    params.cotangent =
        static_cast<float>((1.0 - cone.one_minus_cos) / std::sin(cone.half_angle_rad));
  return params;
}

}  // namespace

LightCone coneOf(const ConeLight& light) {
  const double half_angle_rad = light.direction.w;
  const double half_sin = std::sin(0.5 * half_angle_rad);
  return {glm::normalize(glm::dvec3(light.direction.x, light.direction.y, light.direction.z)),
          half_angle_rad, 2.0 * half_sin * half_sin};
}

std::vector<LightParams> prepareLights(std::span<const ConeLight> lights) {
  std::vector<LightParams> prepared;
  for (const ConeLight& light : lights) prepared.push_back(prepareLight(light));
  return prepared;
}

std::vector<LightParams> prepareLightTree(std::span<const ConeLight> lights) {
  const LightTree tree = lightTree(lights);
  std::vector<LightParams> prepared = prepareLights(tree.lights);
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    prepared[i].skip = tree.skips[i];
    prepared[i].reach = tree.reaches[i];
  }
  return prepared;
}

}  // namespace glintmark
