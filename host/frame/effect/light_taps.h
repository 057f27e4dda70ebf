// Taps of cone lights: directions of equal solid angles that stand for a light where what it meets
// is smooth, as the lobes of multiple scattering are.
#pragma once
#include <span>
#include <vector>

#include "host/core/shared_types.h"
#include "host/fit/multiscatter_types.h"
#include "host/frame/frame_resources.h"
#include "host/frame/shade_arguments.h"

namespace glintmark {

/// Up to this half-angle [rad] a light is one tap, its axis.
inline constexpr double kOneTapHalfAngle_rad = 0.1;
/// Wider lights have a tap for each solid angle of this half-angle.
inline constexpr double kTapHalfAngle_rad = 0.07;
/// Fewer taps than this lie lopsided around the axis.
inline constexpr int kLeastTaps = 14;

struct PreparedTaps {
  std::vector<LightTaps> lights;   // which of the directions are a light's
  std::vector<float4> directions;  // xyz: unit vectors towards the lights' parts
};

/// Taps of all lights, one light's after another's. Directions of lights need not be unit;
/// half-angles are in [0, pi/2].
PreparedTaps prepareTaps(std::span<const ConeLight> lights);

/// Adds the arguments `light_taps` and `taps` of a program that reads them.
void addLightTaps(FrameResources& frame, ShadeArguments& arguments);

}  // namespace glintmark
