// Cone lights made ready for the kernels: wide cones become sets of narrow taps.
#pragma once
#include <span>
#include <vector>

#include "host/core/shared_types.h"

namespace glintmark {

/// Widest half-angle [rad] that one tap stands for. To first order a half vector moves linearly
/// with the light, which tests/frame/test_lights.cpp finds good to about 1 % of the lobe up to
/// here.
inline constexpr double kTapHalfAngle_rad = 0.2;

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
