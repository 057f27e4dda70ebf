// Cone lights made ready for the kernels: wide cones become sets of narrow taps.
#pragma once
#include <span>
#include <vector>

#include "host/core/shared_types.h"

namespace glintmark {

/// Up to this half-angle [rad] a light is one tap: to first order half vectors move linearly with
/// the light, which is good to 1 % of the lobe up to here (host/verify/energy_checks.cpp).
inline constexpr double kOneTapHalfAngle_rad = 0.1;
/// Wider lights are cut into taps of this half-angle. Grazing views decide: 0.1 would leave errors
/// of 20 % of the brightest highlight under a light as wide as the sky, 0.07 leaves 6 %.
inline constexpr double kTapHalfAngle_rad = 0.07;
/// Fewer taps than this lie lopsided around the axis.
inline constexpr int kLeastTaps = 14;

struct PreparedLights {
  std::vector<LightParams> lights;
  std::vector<float4> taps;  // xyz: unit directions towards the lights' parts, equal solid angles
};

/// Turns lights (directions need not be unit, half-angles in [0, pi/2]) into kernel parameters.
/// Irradiance on a surface facing the axis becomes radiance times solid angle.
PreparedLights prepareLights(std::span<const ConeLight> lights);

/// Variance per tangential axis of directions spread evenly over a cone of that cosine, 0 at 1.
double coneVariance(double cos_half_angle);

}  // namespace glintmark
