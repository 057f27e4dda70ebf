// What a surface with a mixture of normals reflects of a polygon, by Monte Carlo in double
// precision.
//
// Normals hide nothing of each other: each carries the microfacet BRDF of microfacet.h and
// Lambert's, sees the light above its own horizon, and shines only where it faces the eye. The mean
// over them is what a pixel shows of a normal map: texels of equal area on the mesh.
#pragma once
#include <glm/glm.hpp>

#include <span>

#include "host/reference/microfacet.h"

namespace glintmark::reference {

/// Shares of a light of radiance 1, at a Fresnel term of 1 and an albedo of 1.
struct MixtureReflection {
  double specular = 0, diffuse = 0;
  double schlick = 0;  // `specular` times (1 - o.m)^5 of each facet m
};

/// A Gaussian of normals, projected onto the tangent plane: [TAN05] Sect. 4.
struct GaussianOfNormals {
  double weight = 1;
  glm::dvec2 mean{0};    // inside the unit disc
  double deviation = 0;  // standard deviation per axis; draws outside the disc are drawn anew
};

/// `view` (unit) and the convex polygon's `vertices`, relative to the point, are in the mesh's
/// tangent frame; the light counts whichever way it turns. alpha > 0; `samples` of each lobe.
MixtureReflection mixtureOverPolygon(Ndf ndf, const glm::dvec3& view, double alpha,
                                     std::span<const GaussianOfNormals> lobes,
                                     std::span<const glm::dvec3> vertices, int samples);

}  // namespace glintmark::reference
