// Projects a mesh's vertices onto the pixel grid.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "host/raster/projection.h"

namespace glintmark {

/// Projects `positions` into `out` (same length). A vertex that is not in front of the near plane,
/// outside the guard band or not finite gets x = kNeedsClipping.
void transformVertices(const Projection& projection, std::span<const glm::vec3> positions,
                       std::span<ScreenVertex> out);

}  // namespace glintmark
