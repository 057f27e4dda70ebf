#include "host/reference/mixture_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
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
bool insideCone(const glm::dvec3& d, std::span<const glm::dvec3> vertices) {
  bool left = true, right = true;
  glm::dvec3 middle(0);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const glm::dvec3& a = vertices[k];
    const double side = glm::dot(glm::cross(a, vertices[(k + 1) % vertices.size()]), d);
    left = left && side >= 0;
    right = right && side <= 0;
    middle += a;
  }
  return (left || right) && glm::dot(middle, d) > 0;
}

// The mirror direction at a facet drawn from D(m) m.z, and G2 (o.m) / (o.z m.z), the BRDF times
// cosine over the density of that direction. [Walter07] Eq. 28, 35, 41
struct Mirrored {
  glm::dvec3 direction;
  double weight = 0;
  double schlick = 0;  // (1 - o.m)^5
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
  const double lambdas =
      microfacetLambda(ndf, result.direction, alpha) + microfacetLambda(ndf, o, alpha);
  result.weight = o_m / ((1 + lambdas) * o.z * m.z);
  result.schlick = std::pow(1 - o_m, 5);
  return result;
}

}  // namespace

MixtureReflection mixtureOverPolygon(Ndf ndf, const glm::dvec3& view, double alpha,
                                     std::span<const GaussianOfNormals> lobes,
                                     std::span<const glm::dvec3> vertices, int samples) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  MixtureReflection mean;
  for (const GaussianOfNormals& lobe : lobes)
    for (int k = 0; k < samples; ++k) {
      glm::dvec2 n;
      do {
        n = lobe.mean + lobe.deviation * glm::dvec2(normal(random), normal(random));
      } while (glm::dot(n, n) >= 1);
      const glm::dmat3 frame = frameAround({n, std::sqrt(1 - glm::dot(n, n))});
      std::vector<glm::dvec3> local;
      local.reserve(vertices.size());
      for (const glm::dvec3& v : vertices) local.push_back(frame * v);
      const std::vector<glm::dvec3> above = clipPolygon(local, {0, 0, 1});
      const double share = lobe.weight / samples;
      if (!above.empty()) mean.diffuse += share * std::abs(polygonFormFactor(above));
      const glm::dvec3 o = frame * view;
      const double u = uniform(random), turn = uniform(random);
      if (o.z <= 0) continue;
      const Mirrored mirrored = sampleMirrored(ndf, o, alpha, u, turn);
      if (!insideCone(mirrored.direction, local)) continue;
      mean.specular += share * mirrored.weight;
      mean.schlick += share * mirrored.weight * mirrored.schlick;
    }
  return mean;
}

}  // namespace glintmark::reference
