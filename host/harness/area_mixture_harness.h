// Lights hand-made mixtures of normals by the area-light kernels.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "host/harness/area_light_harness.h"
#include "host/reference/mixture_light.h"

namespace glintmark {

/// A point of a mesh whose tangent frame is the world's; the eye is the origin of positions.
struct MixturePoint {
  glm::dvec3 position{0};
  glm::dvec3 view{0, 0, 1};  // unit
  std::vector<reference::GaussianOfNormals> lobes;
};

/// Radiance of each point under `lights` (without pictures), with the table that ships for GGX and
/// that of normals. Every point has as many lobes as the first; the base lobe is the material's.
std::vector<glm::vec3> lightMixtures(KernelBench& bench, const MaterialParams& material,
                                     const std::vector<AreaLight>& lights,
                                     const std::vector<MixturePoint>& points, int lanes);

}  // namespace glintmark
