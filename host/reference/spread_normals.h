// A surface whose normals scatter about a mean, none of which hides another: what it reflects of a
// polygon, by Monte Carlo in double precision.
//
// Every normal carries the microfacet BRDF of microfacet.h and Lambert's, sees the light above its
// own horizon, and shines only where it faces the eye. The mean over them is what a pixel shows of
// a normal map: texels of equal area on the mesh, whatever way they face.
#pragma once
#include <glm/glm.hpp>

#include <span>

#include "host/reference/microfacet.h"

namespace glintmark::reference {

/// Shares of a light of radiance 1, at a Fresnel term of 1 and an albedo of 1.
struct SpreadReflection {
  double specular = 0, diffuse = 0;
  double specular_error = 0;  // standard error, as if samples were independent
};

/// Normals are (-x, -y, 1) made unit length, x and y Gaussian with the standard deviation
/// `slope_deviation` (>= 0) in the frame of their mean (z). `view` (unit) and the convex polygon's
/// `vertices`, relative to the point, are in that frame; a light counts whichever way it turns.
/// alpha > 0.
SpreadReflection spreadOverPolygon(Ndf ndf, const glm::dvec3& view, double alpha,
                                   double slope_deviation, std::span<const glm::dvec3> vertices,
                                   int samples);

}  // namespace glintmark::reference
