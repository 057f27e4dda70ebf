// Clips the few triangles that reach behind the near plane or out of the guard band.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/raster/projection.h"

namespace glintmark {

/// A piece of a clipped triangle. Attributes come from the whole triangle, so positions suffice.
struct ClippedTriangle {
  ScreenVertex vertices[3];
  std::uint32_t triangle = 0;  // index of the whole triangle
};

/// Appends the pieces of one triangle to `out`, none if it is invisible or not finite. `corners`
/// are its world positions and `projected` what transformVertices made of them.
void clipTriangle(const Projection& projection, std::uint32_t triangle,
                  const glm::vec3 (&corners)[3], const ScreenVertex (&projected)[3],
                  std::vector<ClippedTriangle>& out);

}  // namespace glintmark
