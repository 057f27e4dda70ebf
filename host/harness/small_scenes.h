// Small scenes made by hand.
#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <utility>

#include "host/scene/scene.h"

namespace glintmark {

inline Material glintMaterial() {
  Material material;
  material.name = "glitter";
  material.params.surface.alpha_g = {0.3f, 0.3f};
  material.params.glints.alpha_l = {0.1f, 0.1f};
  material.params.glints.density = 1e7f;
  material.params.surface.intensity = 1;
  material.params.surface.f0 = {0.9f, 0.8f, 0.7f, 0};
  return material;
}

/// Adds a quad in the plane y = 0 over x in [x0, x1], z in [-8, 8]; one uv unit is one scene unit.
inline void addFloor(Scene& scene, float x0, float x1, std::uint32_t material) {
  TriangleMesh& mesh = scene.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const float z : {8.0f, -8.0f})
    for (const float x : {x0, x1}) {
      mesh.positions.push_back({x, 0, z});
      mesh.normals.push_back({0, 1, 0});
      mesh.tangents.push_back({1, 0, 0, 1});
      mesh.uvs.push_back({x, -z});
    }
  mesh.triangles.push_back({first, first + 1, first + 3});
  mesh.triangles.push_back({first, first + 3, first + 2});
  mesh.triangle_materials.insert(mesh.triangle_materials.end(), 2, material);
}

inline View lookingDown(double angle_deg, double distance = 3) {
  View view;
  view.fov_y_deg = 20;
  Orbit orbit;
  orbit.angle_deg = angle_deg;
  orbit.distance = distance;
  return orbitView(view, orbit);
}

/// A floor of glints that fills the screen under one light.
inline Scene floorScene() {
  Scene scene;
  scene.materials = {glintMaterial()};
  addFloor(scene, -8, 8, 0);
  ConeLight sun{};
  sun.direction = {0, 0.8f, -0.6f, 0};
  sun.irradiance = {3, 3, 3, 0};
  scene.lights = {sun};
  return scene;
}

/// A metal floor with a normal map, four lobes a texel, under two lights.
inline Scene mappedFloor(NormalMap map) {
  Scene scene;
  Material material;
  material.name = "metal";
  material.has_glints = false;
  material.params.surface.alpha_g = {0.3f, 0.3f};
  material.params.glints.alpha_l = {0.1f, 0.1f};
  material.params.glints.density = 1;
  material.params.surface.intensity = 1;
  material.params.surface.f0 = {0.9f, 0.8f, 0.7f, 0};
  material.params.surface.albedo = {0.1f, 0.1f, 0.1f, 0};
  material.normal_map = {std::make_shared<const NormalMap>(std::move(map)), 4};
  scene.materials = {material};
  addFloor(scene, -8, 8, 0);
  for (const float x : {-0.5f, 0.4f}) {
    ConeLight light{};
    light.direction = {x, 0.75f, -0.5f, 0};
    light.irradiance = {2, 2, 2, 0};
    scene.lights.push_back(light);
  }
  return scene;
}

}  // namespace glintmark
