// Cone lights made ready for the kernels: what lobes are integrated over, and taps, directions of
// equal solid angles that stand for a light where what it meets is smooth.
#pragma once
#include <span>
#include <vector>

#include "host/core/shared_types.h"

namespace glintmark {

/// Up to this half-angle [rad] a light is one tap, its axis.
inline constexpr double kOneTapHalfAngle_rad = 0.1;
/// Wider lights have a tap for each solid angle of this half-angle.
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

}  // namespace glintmark
