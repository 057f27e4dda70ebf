#include "host/scene/fit_views.h"

#include <algorithm>
#include <cmath>

namespace glintmark {
namespace {

constexpr double kGrazingAngle_deg = 10;

/// The axis direction that the triangles face most, weighted by area.
glm::dvec3 dominatingSide(const TriangleMesh& mesh) {
  glm::dvec3 front(0), back(0);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 p0 = mesh.positions[t.x];
    const glm::dvec3 area =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - p0, glm::dvec3(mesh.positions[t.z]) - p0);
    front += glm::max(area, 0.0);
    back += glm::max(-area, 0.0);
  }
  // Upwards wins a draw, then +z.
  glm::dvec3 best(0, 1, 0);
  double best_area = front.y;
  for (const int axis : {2, 0, 1}) {
    for (const double sign : {1.0, -1.0}) {
      const double area = sign > 0 ? front[axis] : back[axis];
      if (area <= best_area) continue;
      best_area = area;
      best = glm::dvec3(0);
      best[axis] = sign;
    }
  }
  return best;
}

}  // namespace

void fitViews(const TriangleMesh& mesh, std::vector<View>& views) {
  glm::dvec3 low(mesh.positions[0]), high = low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  const double size = glm::length(high - low);
  const double radius = size > 0 ? 0.5 * size : 1;
  Orbit orbit;
  orbit.target = 0.5 * (low + high);
  orbit.normal = dominatingSide(mesh);
  for (View& view : views) {
    orbit.angle_deg = view.name == "grazing" ? kGrazingAngle_deg : 90;
    orbit.distance = radius / std::sin(glm::radians(0.5 * view.fov_y_deg));
    view.near_plane = 1e-3 * radius;
    view = orbitView(view, orbit);
  }
}

}  // namespace glintmark
