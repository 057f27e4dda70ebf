// Small meshes for the rasterizer's tests.
#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

#include "host/raster/camera.h"
#include "host/scene/scene.h"

namespace glintmark::test {

inline std::uint32_t addVertex(TriangleMesh& mesh, const glm::vec3& position, const glm::dvec2& uv,
                               const glm::vec3& normal = {0, 0, 1},
                               const glm::vec4& tangent = {1, 0, 0, 1}) {
  mesh.positions.push_back(position);
  mesh.uvs.push_back(uv);
  mesh.normals.push_back(normal);
  mesh.tangents.push_back(tangent);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

inline void addTriangle(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                        std::uint32_t material = 0) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangle_materials.push_back(material);
}

/// One triangle with vertices of its own.
inline void addTriangle(TriangleMesh& mesh, const glm::vec3& a, const glm::vec3& b,
                        const glm::vec3& c, std::uint32_t material = 0) {
  const std::uint32_t i = addVertex(mesh, a, {0, 0});
  addVertex(mesh, b, {1, 0});
  addVertex(mesh, c, {0, 1});
  addTriangle(mesh, i, i + 1, i + 2, material);
}

/// A parallelogram of two triangles, uv from (0, 0) at `corner` to `uv_size`.
inline void addQuad(TriangleMesh& mesh, const glm::vec3& corner, const glm::vec3& side_u,
                    const glm::vec3& side_v, const glm::dvec2& uv_origin = {0, 0},
                    const glm::dvec2& uv_size = {1, 1}, std::uint32_t material = 0) {
  const glm::vec3 n = glm::normalize(glm::cross(side_u, side_v));
  const glm::vec4 t(glm::normalize(side_u), 1);
  const std::uint32_t i = addVertex(mesh, corner, uv_origin, n, t);
  addVertex(mesh, corner + side_u, uv_origin + glm::dvec2(uv_size.x, 0), n, t);
  addVertex(mesh, corner + side_u + side_v, uv_origin + uv_size, n, t);
  addVertex(mesh, corner + side_v, uv_origin + glm::dvec2(0, uv_size.y), n, t);
  addTriangle(mesh, i, i + 1, i + 2, material);
  addTriangle(mesh, i, i + 2, i + 3, material);
}

/// A surface P(s, t) over the unit square as n x n quads, uv = (s, t) * uv_scale; smooth frames.
inline TriangleMesh surfaceMesh(int n, const std::function<glm::dvec3(double, double)>& surface,
                                const glm::dvec2& uv_scale = {1, 1}) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      constexpr double kStep = 1e-5;
      const double s = double(i) / n, t = double(j) / n;
      const glm::dvec3 du = surface(s + kStep, t) - surface(s - kStep, t);
      const glm::dvec3 dv = surface(s, t + kStep) - surface(s, t - kStep);
      addVertex(mesh, surface(s, t), glm::dvec2(s, t) * uv_scale,
                glm::normalize(glm::cross(du, dv)), glm::vec4(glm::normalize(du), 1));
    }
  const auto index = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      addTriangle(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1));
      addTriangle(mesh, index(i, j), index(i + 1, j + 1), index(i, j + 1));
    }
  return mesh;
}

/// A torus in the xy plane with waves on it, radius about 1.3, seen from outside.
inline TriangleMesh wavyTorus(int n) {
  return surfaceMesh(n,
                     [](double s, double t) {
                       const double a = 2 * std::numbers::pi * s, b = 2 * std::numbers::pi * t;
                       const double r = 0.4 + 0.03 * std::sin(9 * a) * std::cos(7 * b);
                       return glm::dvec3((1 + r * std::cos(b)) * std::cos(a),
                                         (1 + r * std::cos(b)) * std::sin(a), r * std::sin(b));
                     },
                     {8, 3});
}

inline View lookAt(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_deg = 45,
                   double near_plane = 1e-3) {
  View view;
  view.name = "test";
  view.eye = eye;
  view.target = target;
  view.fov_y_deg = fov_y_deg;
  view.near_plane = near_plane;
  return view;
}

/// A camera at the origin that looks along -z, whose pixel grid at z = -1 has unit spacing: pixel
/// (x, y) is centred at (x - (width - 1) / 2, (height - 1) / 2 - y, -1).
inline Camera unitCamera(int width_px, int height_px) {
  View view = lookAt({0, 0, 0}, {0, 0, -1});
  view.fov_y_deg = 2 * std::atan(0.5 * height_px) * 180 / std::numbers::pi;
  Camera camera = makeCamera(view, width_px, height_px);
  camera.ray_dx = {1, 0, 0};
  camera.ray_dy = {0, -1, 0};
  camera.ray_origin = {-0.5 * (width_px - 1), 0.5 * (height_px - 1), -1};
  return camera;
}

}  // namespace glintmark::test
