#include "host/scene/area_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/shared_types.h"

namespace glintmark {
namespace {

// Sine of the angle by which an outline may turn the wrong way and still count as convex.
constexpr double kStraight = 1e-6;
constexpr double kParallelogramTolerance = 1e-3;

// Newell's normal: twice the area long, defined also where the polygon is not quite flat.
glm::dvec3 newellNormal(const std::vector<glm::dvec3>& vertices) {
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i)
    sum += glm::cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
  return sum;
}

double longestEdge(const std::vector<glm::dvec3>& vertices) {
  double longest = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    longest = std::max(longest, glm::distance(vertices[i], vertices[(i + 1) % vertices.size()]));
  return longest;
}

// Turns left at every corner, and once round in all.
bool isConvex(const std::vector<glm::dvec3>& vertices, const glm::dvec3& normal) {
  const std::size_t n = vertices.size();
  double turned_rad = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 in = glm::normalize(vertices[(i + 1) % n] - vertices[i]);
    const glm::dvec3 out = glm::normalize(vertices[(i + 2) % n] - vertices[(i + 1) % n]);
    const double sine = glm::dot(glm::cross(in, out), normal);
    if (sine < -kStraight) return false;
    turned_rad += std::atan2(sine, glm::dot(in, out));
  }
  return turned_rad < 7;  // 2 pi; a star turns round twice
}

}  // namespace

std::string areaLightComplaint(const AreaLight& light) {
  const std::vector<glm::dvec3>& v = light.vertices;
  if (v.size() < 3 || v.size() > GM_MAX_LIGHT_VERTICES)
    return fmt::format("has {} vertices, expected 3 to {}", v.size(), GM_MAX_LIGHT_VERTICES);
  for (const glm::dvec3& p : v) {
    if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
      return "has a coordinate that is not finite, expected numbers";
  }
  const double size = longestEdge(v);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::size_t next = (i + 1) % v.size();
    if (glm::distance(v[i], v[next]) <= kStraight * size)
      return fmt::format("has its vertices {} and {} in the same place, expected a corner each", i,
                         next);
  }
  const glm::dvec3 doubled = newellNormal(v);
  if (!(glm::length(doubled) > kStraight * size * size))
    return "encloses no area, expected a polygon that is wider than a line";
  const glm::dvec3 normal = glm::normalize(doubled);
  for (std::size_t i = 3; i < v.size(); ++i) {
    if (std::abs(glm::dot(normal, v[i] - v[0])) > kFlatness * size)
      return fmt::format(
          "is not flat: vertex {} is off the plane of the others, expected a planar "
          "polygon",
          i);
  }
  if (!isConvex(v, normal)) return "is not convex, expected a polygon without dents";
  return "";
}

glm::dvec3 areaLightNormal(const AreaLight& light) {
  switch (light.shape) {
    case LightShape::kDisc:
    case LightShape::kTube:
      return glm::normalize(light.axis);
    case LightShape::kSphere:
      return glm::dvec3(0);
    case LightShape::kPolygon:
      break;
  }
  return glm::normalize(newellNormal(light.vertices));
}

double areaLightArea(const AreaLight& light) {
  const double disc = std::numbers::pi * light.radius * light.radius;
  switch (light.shape) {
    case LightShape::kDisc:
      return disc;
    case LightShape::kSphere:
      return 4 * disc;
    case LightShape::kTube:
      return 2 * disc + 2 * std::numbers::pi * light.radius * glm::length(light.axis);
    case LightShape::kPolygon:
      break;
  }
  return 0.5 * glm::length(newellNormal(light.vertices));
}

std::array<glm::dvec3, 2> lightRadii(const glm::dvec3& axis, double radius) {
  const glm::dvec3 n = glm::normalize(axis);
  const glm::dvec3 aside = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(aside, n));
  return {radius * u, radius * glm::cross(n, u)};
}

bool isParallelogram(const AreaLight& light) {
  const std::vector<glm::dvec3>& v = light.vertices;
  return v.size() == 4 &&
         glm::distance(v[0] + v[2], v[1] + v[3]) <= kParallelogramTolerance * longestEdge(v);
}

std::vector<glm::dvec3> rectangleVertices(const glm::dvec3& centre, const glm::dvec3& normal,
                                          const glm::dvec3& up, const glm::dvec2& size) {
  const glm::dvec3 n = glm::normalize(normal);
  const glm::dvec3 right = glm::normalize(glm::cross(up, n));
  const glm::dvec3 half_right = 0.5 * size.x * right;
  const glm::dvec3 half_up = 0.5 * size.y * glm::cross(n, right);
  return {centre - half_right - half_up, centre + half_right - half_up,
          centre + half_right + half_up, centre - half_right + half_up};
}

}  // namespace glintmark
