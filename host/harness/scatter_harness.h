// Runs the kernels' models of multiple scattering over pairs of directions.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "host/harness/kernel_bench.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Unit vectors in tangent space.
struct DirectionPair {
  glm::dvec3 light, view;
};

/// Times the cosine of incidence, at irradiance 1 on a surface that faces the light.
struct ScatteredRadiance {
  double single, multiple;
};

glm::dvec3 directionAt(double cosine, double azimuth_rad);

/// Light and view from straight up to the horizon, at five azimuths between them.
std::vector<DirectionPair> denseDirections();

/// A grey diffuse material.
Material roughMaterial(DiffuseModel model, double alpha, double albedo, double masking = 0);

/// What the kernels of `lanes` lanes make of the pairs, colours of the albedo included. Masking is
/// compiled in where the material has some, or where asked for.
std::vector<ScatteredRadiance> probeScatter(KernelBench& bench,
                                            const std::vector<DirectionPair>& pairs,
                                            const Material& material, int lanes,
                                            bool masking_compiled_in = false);

}  // namespace glintmark
