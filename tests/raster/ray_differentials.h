// Double-precision reference for what a pixel sees of a triangle: the ray is intersected with the
// triangle's plane and differentiated in closed form [Igehy 1999, Tracing Ray Differentials].
#pragma once
#include <algorithm>
#include <cmath>

#include "host/raster/camera.h"
#include "host/scene/scene.h"

namespace glintmark::test {

struct PlaneHit {
  double depth = 0;  // along the view axis
  double ddepth_dx = 0, ddepth_dy = 0;
  glm::dvec3 bary{};                  // of the three corners, sum 1
  glm::dvec3 dbary_dx{}, dbary_dy{};  // per pixel
  glm::dvec2 uv{}, duv_dx{}, duv_dy{};
  glm::dvec3 normal{}, tangent{};         // interpolated, turned to the eye, not normalised
  glm::dvec3 dnormal_dx{}, dnormal_dy{};  // of that normal, per pixel
  bool mirrored = false;
  bool shows_back = false;
};

inline PlaneHit hitPlane(const TriangleMesh& mesh, std::uint32_t triangle, const Camera& camera,
                         double x, double y) {
  const glm::uvec3 index = mesh.triangles[triangle];
  glm::dvec3 p[3];
  for (int i = 0; i < 3; ++i) p[i] = glm::dvec3(mesh.positions[index[i]]) - camera.eye;
  const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
  const glm::dvec3 ray = camera.ray(x, y);
  const double ray_n = glm::dot(ray, n);

  PlaneHit hit;
  hit.depth = glm::dot(p[0], n) / ray_n;
  const glm::dvec3 point = hit.depth * ray;
  // The point moves in the plane: d(depth)/dx keeps dot(point, n) constant.
  const auto moved = [&](const glm::dvec3& d_ray) {
    return hit.depth * (d_ray - ray * (glm::dot(d_ray, n) / ray_n));
  };
  const glm::dvec3 dp_dx = moved(camera.ray_dx), dp_dy = moved(camera.ray_dy);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    const glm::dvec3 gradient = glm::cross(n, c - b) / glm::dot(n, n);
    hit.bary[i] = glm::dot(point - b, gradient);
    hit.dbary_dx[i] = glm::dot(dp_dx, gradient);
    hit.dbary_dy[i] = glm::dot(dp_dy, gradient);
  }

  hit.ddepth_dx = glm::dot(dp_dx, camera.forward);
  hit.ddepth_dy = glm::dot(dp_dy, camera.forward);

  hit.shows_back = glm::dot(p[0], n) > 0;
  const glm::dvec2 uv0 = mesh.uvs[index[0]];
  hit.uv = uv0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec2 uv = mesh.uvs[index[i]] - uv0;
    hit.uv += hit.bary[i] * uv;
    hit.duv_dx += hit.dbary_dx[i] * uv;
    hit.duv_dy += hit.dbary_dy[i] * uv;
    hit.normal += hit.bary[i] * glm::dvec3(mesh.normals[index[i]]);
    hit.dnormal_dx += hit.dbary_dx[i] * glm::dvec3(mesh.normals[index[i]]);
    hit.dnormal_dy += hit.dbary_dy[i] * glm::dvec3(mesh.normals[index[i]]);
    hit.tangent += hit.bary[i] * glm::dvec3(mesh.tangents[index[i]]);
  }
  if (hit.shows_back)
    for (glm::dvec3* turned : {&hit.normal, &hit.dnormal_dx, &hit.dnormal_dy}) *turned = -*turned;
  hit.mirrored = (mesh.tangents[index[0]].w < 0) != hit.shows_back;
  return hit;
}

/// Distance on the screen [px] from a pixel centre to the nearest edge line of the triangle, or to
/// the line where the near plane cuts it.
inline double edgeDistance(const PlaneHit& hit, double near_plane) {
  double distance = std::abs(hit.depth - near_plane) / std::hypot(hit.ddepth_dx, hit.ddepth_dy);
  for (int i = 0; i < 3; ++i)
    distance =
        std::min(distance, std::abs(hit.bary[i]) / std::hypot(hit.dbary_dx[i], hit.dbary_dy[i]));
  return distance;
}

}  // namespace glintmark::test
