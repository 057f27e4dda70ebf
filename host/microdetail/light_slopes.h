// The half vectors of a light as slopes, and the probability that a microdetail mirrors it.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "host/core/float4.h"
#include "host/reference/light_cone.h"

namespace glintmark {

/// A light as microdetails see it: the sum over `taps` of weight * D_l(slope - m) / D_l(0) is the
/// share of the light that a microdetail of slope m mirrors, at most 1.
struct LightSlopes {
  std::vector<float4> taps;  // x, y: slope; z: weight
  double probability = 0;    // the share's mean over the slopes of microdetails. [ZK16] Eq. 7
};

/// Of a light that is a point: one half vector.
LightSlopes pointSlopes(const glm::dvec2& half_slope, const glm::dvec2& alpha_g,
                        const glm::dvec2& alpha_l);

/// Of a cone, seen from direction `view` (unit, tangent frame): `samples` directions of equal solid
/// angle. They must lie within a fraction of alpha_l of each other for the sum to be the integral.
/// Throws Error if all of the cone is below the horizon.
LightSlopes coneSlopes(const reference::Cone& light, const glm::dvec3& view,
                       const glm::dvec2& alpha_g, const glm::dvec2& alpha_l, int samples);

}  // namespace glintmark
