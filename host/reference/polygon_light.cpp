#include "host/reference/polygon_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace glintmark::reference {
namespace {

// Triangles of the cubature are halved until no side spans a larger angle in the space of the
// cosine lobe, where a BRDF varies over about one radian.
constexpr double kLargestSide_rad = 0.15;
constexpr int kDeepest = 40;

const glm::dvec3 kUp{0, 0, 1};

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Sum over edges of angle times unit normal of the edge's plane: 2 pi times the vector form factor
// of a polygon above the horizon. [Lambert1760]
double edgeSum(std::span<const glm::dvec3> vertices) {
  double sum = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3 a = glm::normalize(vertices[i]);
    const glm::dvec3 b = glm::normalize(vertices[(i + 1) % vertices.size()]);
    const glm::dvec3 cross = glm::cross(a, b);
    const double sine = glm::length(cross);
    if (sine > 0) sum += std::atan2(sine, glm::dot(a, b)) * cross.z / sine;
  }
  return sum;
}

struct Triangle {
  glm::dvec3 a, b, c;
};

// Radon's seven points, exact to degree five, over u, v >= 0, u + v <= 1; weights sum to 1.
struct CubaturePoint {
  double u, v, weight;
};
std::array<CubaturePoint, 7> radonPoints() {
  const double root = std::sqrt(15.0);
  const double near = (6 - root) / 21, far = (6 + root) / 21;
  const double near_weight = (155 - root) / 1200, far_weight = (155 + root) / 1200;
  return {{{1.0 / 3, 1.0 / 3, 9.0 / 40},
           {near, near, near_weight},
           {1 - 2 * near, near, near_weight},
           {near, 1 - 2 * near, near_weight},
           {far, far, far_weight},
           {1 - 2 * far, far, far_weight},
           {far, 1 - 2 * far, far_weight}}};
}

template <typename Integrand>
double integrateTriangle(const Triangle& t, const glm::dmat3& inverse, const Integrand& integrand,
                         int depth) {
  const glm::dvec3 a = inverse * t.a, b = inverse * t.b, c = inverse * t.c;
  const double ab = angleBetween(a, b), bc = angleBetween(b, c), ca = angleBetween(c, a);
  const double longest = std::max({ab, bc, ca});
  if (longest > kLargestSide_rad && depth < kDeepest) {
    // Halved across its longest side, at the middle of the angle it spans.
    const auto split = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& rest) {
      const double p_length = glm::length(inverse * p), q_length = glm::length(inverse * q);
      const glm::dvec3 middle = (p * q_length + q * p_length) / (p_length + q_length);
      return integrateTriangle({p, middle, rest}, inverse, integrand, depth + 1) +
             integrateTriangle({middle, q, rest}, inverse, integrand, depth + 1);
    };
    if (longest == ab) return split(t.a, t.b, t.c);
    return longest == bc ? split(t.b, t.c, t.a) : split(t.c, t.a, t.b);
  }
  static const std::array<CubaturePoint, 7> kPoints = radonPoints();
  // Solid angle element: distance of the plane over the cube of the distance of the point.
  const double volume = 0.5 * glm::dot(t.a, glm::cross(t.b, t.c));
  double sum = 0;
  for (const CubaturePoint& point : kPoints) {
    const glm::dvec3 p = t.a + point.u * (t.b - t.a) + point.v * (t.c - t.a);
    const double length = glm::length(p);
    sum += point.weight * integrand(p / length) / (length * length * length);
  }
  return sum * volume;
}

}  // namespace

std::vector<glm::dvec3> clipPolygon(std::span<const glm::dvec3> vertices,
                                    const glm::dvec3& normal) {
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3 &a = vertices[i], &b = vertices[(i + 1) % vertices.size()];
    const double height_a = glm::dot(a, normal), height_b = glm::dot(b, normal);
    if (height_a >= 0) kept.push_back(a);
    if ((height_a > 0 && height_b < 0) || (height_a < 0 && height_b > 0)) {
      kept.push_back((a * height_b - b * height_a) / (height_b - height_a));
    }
  }
  return kept;
}

double polygonSolidAngle(std::span<const glm::dvec3> vertices) {
  // Triangles of a fan, each by [Oosterom1983]: tan(angle / 2) = det / (1 + cosines).
  double sum = 0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const glm::dvec3 a = glm::normalize(vertices[0]), b = glm::normalize(vertices[i]),
                     c = glm::normalize(vertices[i + 1]);
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                          1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  }
  return sum;
}

double polygonFormFactor(std::span<const glm::dvec3> vertices) {
  return edgeSum(clipPolygon(vertices, kUp)) / (2 * std::numbers::pi);
}

double ltcOverPolygon(const glm::dmat3& inverse, std::span<const glm::dvec3> vertices) {
  std::vector<glm::dvec3> above = clipPolygon(vertices, kUp);
  for (glm::dvec3& vertex : above) vertex = inverse * vertex;
  return polygonFormFactor(above);
}

double microfacetOverPolygon(Ndf ndf, const glm::dvec3& view, double alpha, double f0,
                             const glm::dmat3& inverse, std::span<const glm::dvec3> vertices) {
  const std::vector<glm::dvec3> above = clipPolygon(vertices, kUp);
  const auto integrand = [&](const glm::dvec3& light) {
    const double view_dot_half = std::sqrt(std::max(0.0, 0.5 * (1 + glm::dot(light, view))));
    const double schlick = std::pow(1 - std::min(view_dot_half, 1.0), 5);
    return microfacetTimesCosine(ndf, light, view, alpha) * (f0 + (1 - f0) * schlick);
  };
  double sum = 0;
  for (std::size_t i = 1; i + 1 < above.size(); ++i) {
    sum += integrateTriangle({above[0], above[i], above[i + 1]}, inverse, integrand, 0);
  }
  return sum;
}

}  // namespace glintmark::reference
