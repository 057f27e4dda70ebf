// Brute force over the directions of a polygon light: the share of microdetails that mirror it.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "host/reference/microfacet.h"

namespace glintmark::reference {

/// What microdetails are a part of: the surface's lobe, and that of one microdetail.
struct DetailLobes {
  Ndf ndf = Ndf::kBeckmann;  // of the surface
  double alpha_g = 1;
  glm::dvec2 alpha_l{1};  // Beckmann, along u and v
};

/// [ZK16] Eq. 7 for a polygon: the share of the surface's slopes that mirror some of the light into
/// the eye, over the share of one microdetail's lobe that does, where it points best: the peak that
/// is climbed to from the mean of those slopes. Vertices are positions relative to the point,
/// tangent frame (z: normal), convex, in any sense of rotation; the part below the horizon adds
/// nothing. `view`: unit, z > 0. At most 1; 0 out of reach.
double polygonProbability(std::span<const glm::dvec3> vertices, const glm::dvec3& view,
                          const DetailLobes& lobes, int samples);

/// The share of a lobe of slopes that a light too small for the lobe to vary over takes up:
/// density of the slope at the light's middle, times the area of its half vectors' slopes.
double pointShare(const glm::dvec3& direction, double solid_angle_sr, const glm::dvec3& view,
                  const DetailLobes& lobes);

}  // namespace glintmark::reference
