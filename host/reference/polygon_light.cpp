#include "host/reference/polygon_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace glintmark::reference {
namespace {

// Triangles of the cubature are halved until no side is longer than this: in units of the lobe's
// widths plus the distance from its centre, on the plane on which it is a round bump, and in radian
// away from it. Tails fall like powers of the distance, so that both are as smooth.
constexpr double kLongestSide = 0.15;
constexpr double kLeastPlaneCosine = 1e-3;  // to that plane's axis; it stands for all beyond
constexpr int kDeepest = 100;

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

// Integrates over spherical triangles. Only the directions of their corners matter; corners are
// kept at unit length in the space of the cosine lobe, so that sides are halved there.
template <typename Integrand>
class TriangleCubature {
 public:
  TriangleCubature(const glm::dmat3& inverse, const Integrand& integrand)
      : inverse_(inverse), integrand_(integrand) {}

  double integrate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   int depth = 0) const {
    const glm::dvec3 p = scaled(a), q = scaled(b), r = scaled(c);
    const double pq = side(p, q), qr = side(q, r), rp = side(r, p);
    const double longest = std::max({pq, qr, rp});
    if (longest <= kLongestSide || depth >= kDeepest) return sevenPoints(p, q, r);
    if (longest == pq) return halved(p, q, r, depth);
    return longest == qr ? halved(q, r, p, depth) : halved(r, p, q, depth);
  }

 private:
  glm::dvec3 scaled(const glm::dvec3& p) const { return p / glm::length(inverse_ * p); }

  glm::dvec2 onPlane(const glm::dvec3& p) const {
    const glm::dvec3 lobe = inverse_ * p;
    return glm::dvec2(lobe) / std::max(lobe.z, kLeastPlaneCosine);
  }

  double side(const glm::dvec3& p, const glm::dvec3& q) const {
    const glm::dvec2 on_plane_p = onPlane(p), on_plane_q = onPlane(q);
    const double nearest = std::min(glm::length(on_plane_p), glm::length(on_plane_q));
    return std::max({angleBetween(inverse_ * p, inverse_ * q),
                     glm::length(on_plane_p - on_plane_q) / (1 + nearest),
                     0.5 * angleBetween(p, q)});
  }

  double halved(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& rest, int depth) const {
    const glm::dvec3 middle = p + q;
    return integrate(p, middle, rest, depth + 1) + integrate(middle, q, rest, depth + 1);
  }

  double sevenPoints(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const {
    static const std::array<CubaturePoint, 7> points = radonPoints();
    double sum = 0;
    for (const CubaturePoint& point : points) {
      const glm::dvec3 p = a + point.u * (b - a) + point.v * (c - a);
      const double length = glm::length(p);
      sum += point.weight * integrand_(p / length) / (length * length * length);
    }
    // Solid angle element: distance of the plane times its area, over the cube of the distance.
    return sum * 0.5 * glm::dot(a, glm::cross(b, c));
  }

  glm::dmat3 inverse_;
  const Integrand& integrand_;
};

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
  const TriangleCubature cubature(inverse, integrand);
  double sum = 0;
  for (std::size_t i = 1; i + 1 < above.size(); ++i) {
    sum += cubature.integrate(above[0], above[i], above[i + 1]);
  }
  return sum;
}

}  // namespace glintmark::reference
