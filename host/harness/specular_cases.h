// Random points that see a quad light in a rough mirror.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "host/fit/ltc_table.h"
#include "host/harness/area_light_harness.h"

namespace glintmark {

/// The table that ships for GGX, read once.
const LtcTable& shippedGgx();

struct SpecularCase {
  HandMadePoint point;
  std::vector<glm::dvec3> local;  // the light's vertices in the table's frame
};

/// A two-sided quad about the origin.
AreaLight specularQuad();

/// Views at least 3 degrees above the surface, roughness from `least_alpha` to 1.
std::vector<SpecularCase> specularCases(int count, const AreaLight& light, double least_alpha);

/// What a white surface reflects of the light at each point, by the kernels.
std::vector<glm::vec3> shadeSpecular(KernelBench& bench, const AreaLight& light,
                                     const std::vector<SpecularCase>& cases, int lanes);

}  // namespace glintmark
