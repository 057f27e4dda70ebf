#include "host/reference/round_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/polygon_light.h"

namespace glintmark::reference {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Across {
  glm::dvec3 u, v;  // unit, right-handed with the axis
};

Across acrossAxis(const glm::dvec3& axis) {
  const glm::dvec3 n = glm::normalize(axis);
  const glm::dvec3 other = std::abs(n.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(other, n));
  return {u, glm::cross(n, u)};
}

std::vector<glm::dvec3> circle(const glm::dvec3& centre, const glm::dvec3& axis, double radius,
                               int sides) {
  const Across across = acrossAxis(axis);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < sides; ++i) {
    const double t = kTurn * i / sides;
    points.push_back(centre + radius * (std::cos(t) * across.u + std::sin(t) * across.v));
  }
  return points;
}

// The ends whose outside faces the origin.
std::vector<glm::dvec3> seenEnds(const RoundLight& light) {
  std::vector<glm::dvec3> ends;
  if (glm::dot(light.centre, light.axis) > 0) ends.push_back(light.centre);
  if (glm::dot(light.centre + light.axis, light.axis) < 0)
    ends.push_back(light.centre + light.axis);
  return ends;
}

// Pieces of a disc, by rings of equal area.
void addDiscPieces(const glm::dvec3& centre, const glm::dvec3& axis, double radius, int steps,
                   std::vector<LightPiece>& pieces) {
  const Across across = acrossAxis(axis);
  const glm::dvec3 normal = glm::normalize(axis);
  const double area = std::numbers::pi * radius * radius / (static_cast<double>(steps) * steps);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double r = radius * std::sqrt((i + 0.5) / steps), t = kTurn * (j + 0.5) / steps;
      const glm::dvec3 p = centre + r * (std::cos(t) * across.u + std::sin(t) * across.v);
      const double length = glm::length(p);
      pieces.push_back({p / length, area * std::abs(glm::dot(p, normal)) / std::pow(length, 3)});
    }
}

void addSidePieces(const RoundLight& light, int steps, std::vector<LightPiece>& pieces) {
  const Across across = acrossAxis(light.axis);
  const int around = 2 * steps;
  const double area =
      kTurn * light.radius * glm::length(light.axis) / (static_cast<double>(around) * steps);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < around; ++j) {
      const double t = kTurn * (j + 0.5) / around;
      const glm::dvec3 normal = std::cos(t) * across.u + std::sin(t) * across.v;
      const glm::dvec3 p = light.centre + (i + 0.5) / steps * light.axis + light.radius * normal;
      const double facing = -glm::dot(p, normal), length = glm::length(p);
      if (facing > 0) pieces.push_back({p / length, area * facing / std::pow(length, 3)});
    }
}

bool meetsDisc(const glm::dvec3& centre, const glm::dvec3& axis, double radius,
               const glm::dvec3& direction) {
  const double facing = glm::dot(direction, axis);
  if (facing == 0) return false;
  const double reach = glm::dot(centre, axis) / facing;
  return reach > 0 && glm::distance(reach * direction, centre) <= radius;
}

}  // namespace

std::vector<std::vector<glm::dvec3>> roundFacets(const RoundLight& light, int sides) {
  if (light.shape == RoundLight::Shape::kDisc)
    return {circle(light.centre, light.axis, light.radius, sides)};
  if (light.shape == RoundLight::Shape::kSphere) {
    // Where the tangents of the origin touch.
    const double distance = glm::length(light.centre), sine = light.radius / distance;
    const double cosine = std::sqrt((1 - sine) * (1 + sine));
    return {circle(light.centre * cosine * cosine, light.centre, light.radius * cosine, sides)};
  }
  std::vector<std::vector<glm::dvec3>> facets;
  for (const glm::dvec3& end : seenEnds(light))
    facets.push_back(circle(end, light.axis, light.radius, sides));
  const std::vector<glm::dvec3> rim = circle(light.centre, light.axis, light.radius, sides);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const glm::dvec3 a = rim[i], b = rim[(i + 1) % rim.size()];
    const glm::dvec3 outwards = glm::cross(b - a, light.axis);
    if (glm::dot(outwards, a) < 0) facets.push_back({a, b, b + light.axis, a + light.axis});
  }
  return facets;
}

double ltcOverRoundLight(const glm::dmat3& inverse, const RoundLight& light, int sides) {
  double sum = 0;
  for (const std::vector<glm::dvec3>& facet : roundFacets(light, sides)) {
    const std::vector<glm::dvec3> clipped = clipPolygon(facet, {0, 0, 1});
    if (clipped.size() >= 3) sum += std::abs(ltcOverPolygon(inverse, clipped));
  }
  return sum;
}

bool meetsRoundLight(const RoundLight& light, const glm::dvec3& direction) {
  if (light.shape == RoundLight::Shape::kDisc)
    return meetsDisc(light.centre, light.axis, light.radius, direction);
  if (light.shape == RoundLight::Shape::kSphere)
    return glm::dot(light.centre, direction) > 0 &&
           glm::length(glm::cross(light.centre, direction)) <=
               light.radius * glm::length(direction);
  const glm::dvec3 axis = glm::normalize(light.axis);
  for (const glm::dvec3& end : {light.centre, light.centre + light.axis})
    if (meetsDisc(end, axis, light.radius, direction)) return true;
  // Roots of the distance from the axis; either may lie between the ends.
  const glm::dvec3 d = direction - glm::dot(direction, axis) * axis,
                   c = light.centre - glm::dot(light.centre, axis) * axis;
  const double a = glm::dot(d, d), b = glm::dot(d, c),
               rest = b * b - a * (glm::dot(c, c) - light.radius * light.radius);
  if (!(a > 0) || rest < 0) return false;
  for (const double root : {-std::sqrt(rest), std::sqrt(rest)}) {
    const double reach = (b + root) / a;
    const double height = glm::dot(reach * direction - light.centre, axis);
    if (reach > 0 && height >= 0 && height <= glm::length(light.axis)) return true;
  }
  return false;
}

double ltcByRays(const glm::dmat3& inverse, const RoundLight& light, int side) {
  const glm::dmat3 forward = glm::inverse(inverse);
  int met = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      // Even on the disc below a cosine; rows shifted so that they do not line up.
      const double r = std::sqrt((i + 0.5) / side), t = kTurn * (j + 0.5 + 0.618034 * i) / side;
      const glm::dvec3 cosine(r * std::cos(t), r * std::sin(t), std::sqrt(1 - r * r));
      const glm::dvec3 direction = forward * cosine;
      met += direction.z > 0 && meetsRoundLight(light, direction);
    }
  return met / (static_cast<double>(side) * side);
}

std::vector<LightPiece> roundPieces(const RoundLight& light, int steps) {
  std::vector<LightPiece> pieces;
  if (light.shape == RoundLight::Shape::kTube) {
    addSidePieces(light, steps, pieces);
    for (const glm::dvec3& end : seenEnds(light))
      addDiscPieces(end, light.axis, light.radius, steps, pieces);
    return pieces;
  }
  if (light.shape == RoundLight::Shape::kDisc) {
    addDiscPieces(light.centre, light.axis, light.radius, steps, pieces);
    return pieces;
  }
  const double sine = light.radius / glm::length(light.centre);
  const double spread = 1 - std::sqrt((1 - sine) * (1 + sine));
  const Across across = acrossAxis(light.centre);
  const glm::dvec3 axis = glm::normalize(light.centre);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double z = 1 - spread * (i + 0.5) / steps, t = kTurn * (j + 0.5) / steps;
      const glm::dvec3 around = std::cos(t) * across.u + std::sin(t) * across.v;
      pieces.push_back({z * axis + std::sqrt(1 - z * z) * around,
                        kTurn * spread / (static_cast<double>(steps) * steps)});
    }
  return pieces;
}

}  // namespace glintmark::reference
