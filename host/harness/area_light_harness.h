// Lights hand-made points by the area-light kernels.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "host/core/shared_types.h"
#include "host/fit/anisotropic_table.h"
#include "host/fit/ltc_table.h"
#include "host/harness/kernel_bench.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/area_light.h"

namespace glintmark {

/// A surface point; the eye is the origin of positions.
struct HandMadePoint {
  glm::dvec3 position{0};
  glm::dvec3 normal{0, 0, 1};
  glm::dvec3 view{0, 0, 1};  // unit
  double alpha = 1;          // of anisotropic probes, along `axis`
  double alpha_across = 1;
  glm::dvec3 axis{1, 0, 0};  // not along the normal
};

struct AreaLightProbe {
  MaterialParams material{};
  std::vector<AreaLight> lights;
  LtcTable table;
  /// Lobes are stretched, by this table; null: they are round.
  const AnisotropicTable* anisotropic = nullptr;
  int width = 16;
  bool clipless = false;
};

/// Radiance of each point. Vertices, diffuse term and pictures as the frame would choose them.
std::vector<glm::vec3> lightPoints(KernelBench& bench, const AreaLightProbe& probe,
                                   const std::vector<HandMadePoint>& points);

/// Overall roughness by the kernels. `lengths` are of mean normals.
std::vector<float> footprintAlphas(KernelBench& bench, LtcMethod method, float micro,
                                   const std::vector<float>& lengths, int width);

/// A table whose lobe is the clamped cosine itself, where the view is along the normal and alpha 1.
LtcTable identityTable();

/// White, without Fresnel; only one of the two lobes.
MaterialParams whiteSpecular();
MaterialParams whiteDiffuse();

AreaLight polygonLight(std::vector<glm::dvec3> vertices, bool two_sided = false);

}  // namespace glintmark
