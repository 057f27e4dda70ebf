#include "host/experiment/glints/glints_plane.h"

#include <cmath>
#include <numbers>

#include "host/core/float4.h"

namespace glintmark {
namespace {

constexpr double kFov_deg = 2;  // so that half vectors are nearly the same all over
constexpr double kDistance = 10;
constexpr double kHalfWidth = 1;
constexpr double kPixel_uv = 0x1p-10;  // the side of a square of a pixel's area
constexpr double kTexture_rad = 0.5;   // no footprint lies along an axis

// Towards the light whose half vector with the normal has this slope.
glm::dvec3 lightOf(double slope, double azimuth_rad) {
  const double angle = 2 * std::atan(slope);
  return {std::sin(angle) * std::cos(azimuth_rad), std::cos(angle),
          -std::sin(angle) * std::sin(azimuth_rad)};
}

void addQuad(TriangleMesh& mesh, double uv_per_unit, double aspect) {
  const double c = std::cos(kTexture_rad), s = std::sin(kTexture_rad), root = std::sqrt(aspect);
  for (const double z : {kHalfWidth, -kHalfWidth})
    for (const double x : {-kHalfWidth, kHalfWidth}) {
      const double along = x * uv_per_unit * root, across = -z * uv_per_unit / root;
      mesh.positions.push_back(glm::vec3(x, 0, z));
      mesh.normals.push_back({0, 1, 0});
      mesh.tangents.push_back({1, 0, 0, 1});
      mesh.uvs.push_back({c * along - s * across, s * along + c * across});
    }
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}};
  mesh.triangle_materials = {0, 0};
}

}  // namespace

Scene glintPlane(const GlintStage& stage, int lights, int height_px) {
  Scene scene;
  scene.name = "plane";
  const double pixel = 2 * kDistance * std::tan(kFov_deg * std::numbers::pi / 360) / height_px;
  addQuad(scene.mesh, kPixel_uv / pixel, stage.aspect);

  Material material;
  material.name = "glints";
  material.params = glintMaterial(stage, 0);
  material.params.glints.density =
      static_cast<float>(stage.lambda / (glintLight(stage).probability * kPixel_uv * kPixel_uv));
  scene.materials = {material};

  const double slope = glm::length(kGlintHalfSlope);
  const double first = std::atan2(kGlintHalfSlope.y, kGlintHalfSlope.x);
  for (int i = 0; i < lights; ++i) {
    ConeLight light{};
    light.direction = toFloat4(lightOf(slope, first + 2 * std::numbers::pi * i / 3));
    light.irradiance = {1, 1, 1, 0};
    scene.lights.push_back(light);
  }

  View view;
  view.name = "plane";
  view.fov_y_deg = kFov_deg;
  Orbit orbit;
  orbit.distance = kDistance;
  scene.views = {orbitView(view, orbit)};
  return scene;
}

}  // namespace glintmark
