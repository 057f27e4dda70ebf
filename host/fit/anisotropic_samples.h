// Deterministic cubature over the hemisphere for lobes of anisotropic BRDFs.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "host/reference/microfacet.h"

namespace glintmark {

/// A BRDF seen from one direction. Directions are in the frame of view and normal: z along the
/// normal, the view in the plane of x and z, x >= 0.
struct AnisotropicView {
  reference::Ndf ndf = reference::Ndf::kGgx;
  glm::dvec2 alpha{1};   // roughness along the surface's own axes u and v, both > 0
  double cos_theta = 1;  // of the view to the normal, [0, 1]
  double phi_rad = 0;    // azimuth of the view from u towards v

  glm::dvec3 view() const;
  /// A direction as the surface's own axes have it.
  glm::dvec3 toSurface(const glm::dvec3& direction) const;
  /// And back.
  glm::dvec3 fromSurface(const glm::dvec3& direction) const;
  /// BRDF times cosine at a Fresnel term of 1.
  double brdf(const glm::dvec3& direction) const;
};

/// Directions over the hemisphere, with weights such that sum weight g(i) approximates the integral
/// of g.
struct AnisotropicSamples {
  std::vector<glm::dvec3> direction;
  std::vector<double> weight;
  std::vector<double> brdf;  // BRDF times cosine at F0 = 1
  double albedo = 0;         // integrals of brdf, and of brdf times (1 - o.h)^5
  double schlick_albedo = 0;
};

struct AnisotropicSampleCounts {
  int facet_radial = 28, facet_azimuth = 40;
  int lobe_radial = 22, lobe_azimuth = 40;
  int hemisphere_radial = 10, hemisphere_azimuth = 24;
};

/// Grids in the unit squares of three densities, weighted by the balance heuristic [Veach97]
/// Eq. 9.8: mirror images of the BRDF's facets, which may lie along a thin arc; the cosine lobe
/// transformed by the inverse of `inverse`; and the whole hemisphere. All but the last are widened.
AnisotropicSamples makeAnisotropicSamples(const AnisotropicView& view, const glm::dmat3& inverse,
                                          const AnisotropicSampleCounts& counts = {});

}  // namespace glintmark
