// Cone lights made ready for the kernels: what lobes are integrated over.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "host/core/shared_types.h"

namespace glintmark {

/// The directions that a light fills. Its half-angle is in [0, pi/2].
struct LightCone {
  glm::dvec3 axis;  // unit vector towards the light
  double half_angle_rad;
  double one_minus_cos;  // of the half-angle; the solid angle over 2 pi
};

/// `light.direction` need not be unit.
LightCone coneOf(const ConeLight& light);

/// Turns lights (directions need not be unit, half-angles in [0, pi/2]) into kernel parameters.
/// Irradiance on a surface facing the axis becomes radiance times solid angle.
std::vector<LightParams> prepareLights(std::span<const ConeLight> lights);

/// The same as a tree that programs of LIGHT_CUT walk, in the order of lightTree().
std::vector<LightParams> prepareLightTree(std::span<const ConeLight> lights);

}  // namespace glintmark
