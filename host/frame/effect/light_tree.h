// Many cones of light as a tree, of which a pixel takes no more parts than its lobe tells apart.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "host/core/shared_types.h"

namespace glintmark {

/// Cones in the order of a walk: each stands before its parts.
struct LightTree {
  std::vector<ConeLight> lights;
  std::vector<unsigned> skips;  // entries to the next that is no part of it; 1: it has no parts
  std::vector<float> reaches;   // chord from its axis that all directions of its parts are within
};

/// Points stand alone. Cones whose radiance is of the same factor of 4 are halved by direction
/// again and again; a cone that stands for others has their flux, their mean direction, and the
/// half-angle of an even cone of as long a mean direction, as cones cut from a map have. Directions
/// need not be unit.
LightTree lightTree(std::span<const ConeLight> lights);

}  // namespace glintmark
