// Polygons as triangles.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace glintmark {

/// Cuts one polygon with `corners` in order, dented or not, into corners.size() - 2 triangles of
/// positions in `corners`; none for fewer than three corners. A polygon that is not flat is cut as
/// its projection along its mean normal is; one that crosses itself is cut somehow.
void triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<int, 3>>& out);

}  // namespace glintmark
