#include "host/reference/spread_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/reference/polygon_light.h"

namespace glintmark::reference {
namespace {

// Rows: tangent, bitangent, normal.
glm::dmat3 frameAround(const glm::dvec3& n) {
  const glm::dvec3 t = glm::normalize(glm::dvec3(1, 0, 0) - n.x * n);
  return glm::transpose(glm::dmat3(t, glm::cross(n, t), n));
}

// Is the ray from the origin along d inside the polygon's cone, whichever way its vertices turn?
bool hits(const glm::dvec3& d, std::span<const glm::dvec3> vertices) {
  bool left = true, right = true;
  glm::dvec3 middle(0);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const glm::dvec3& a = vertices[k];
    const glm::dvec3& b = vertices[(k + 1) % vertices.size()];
    const double side = glm::dot(glm::cross(a, b), d);
    left = left && side >= 0;
    right = right && side <= 0;
    middle += a;
  }
  return (left || right) && glm::dot(middle, d) > 0;
}

// A number of [0, 1) of sample k along one of four axes: Kronecker's sequence of the powers of the
// root of x^5 = x + 1.
double uniform(int k, int axis) {
  constexpr double kRoot = 1.1673039782614187;
  return std::fmod(0.5 + (k + 1) * std::pow(kRoot, -(axis + 1)), 1.0);
}

// The mirror direction at a facet drawn from D(m) m.z, and G2 (o.m) / (o.z m.z), the BRDF times
// cosine over the density of that direction. [Walter07] Eq. 28, 35, 41
struct Mirrored {
  glm::dvec3 direction;
  double weight = 0;
};

Mirrored sampleMirrored(Ndf ndf, const glm::dvec3& o, double alpha, double u, double turn) {
  const double tan_sq =
      ndf == Ndf::kGgx ? alpha * alpha * u / (1 - u) : -alpha * alpha * std::log(1 - u);
  const double z = 1 / std::sqrt(1 + tan_sq), r = std::sqrt(tan_sq) * z;
  const double phi = 2 * std::numbers::pi * turn;
  const glm::dvec3 m(r * std::cos(phi), r * std::sin(phi), z);
  const double o_m = glm::dot(o, m);
  Mirrored result{2 * o_m * m - o};
  if (o_m <= 0 || result.direction.z <= 0) return result;
  const double g =
      1 / (1 + microfacetLambda(ndf, result.direction, alpha) + microfacetLambda(ndf, o, alpha));
  result.weight = g * o_m / (o.z * m.z);
  return result;
}

}  // namespace

SpreadReflection spreadOverPolygon(Ndf ndf, const glm::dvec3& view, double alpha,
                                   double slope_deviation, std::span<const glm::dvec3> vertices,
                                   int samples) {
  SpreadReflection mean;
  double squares = 0;
  for (int k = 0; k < samples; ++k) {
    const double radius = slope_deviation * std::sqrt(-2 * std::log(1 - uniform(k, 0)));
    const double turn = 2 * std::numbers::pi * uniform(k, 1);
    const glm::dmat3 frame = frameAround(
        glm::normalize(glm::dvec3(-radius * std::cos(turn), -radius * std::sin(turn), 1)));
    std::vector<glm::dvec3> local;
    for (const glm::dvec3& v : vertices) local.push_back(frame * v);
    const std::vector<glm::dvec3> above = clipPolygon(local, {0, 0, 1});
    if (!above.empty()) mean.diffuse += std::abs(polygonFormFactor(above));
    const glm::dvec3 o = frame * view;
    if (o.z <= 0) continue;
    const Mirrored mirrored = sampleMirrored(ndf, o, alpha, uniform(k, 2), uniform(k, 3));
    if (mirrored.weight <= 0 || !hits(mirrored.direction, local)) continue;
    mean.specular += mirrored.weight;
    squares += mirrored.weight * mirrored.weight;
  }
  mean.diffuse /= samples;
  mean.specular /= samples;
  mean.specular_error =
      std::sqrt(std::max(0.0, squares / samples - mean.specular * mean.specular) / samples);
  return mean;
}

}  // namespace glintmark::reference
