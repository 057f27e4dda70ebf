// A glint method over a lattice of pixels.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "host/core/shared_types.h"
#include "host/microdetail/pixel_lattice.h"
#include "host/ocl/compute.h"

namespace glintmark {

/// What the method of `config` makes of the smooth lobe under a point light whose half vector has
/// the slope `half_slope` at every pixel: 1 on average, for each lattice its pixels. `config` has
/// glint on; its planes are not read. `table`: what the method looks up, if it does. One launch.
std::vector<std::vector<glm::vec3>> methodRatios(Device& device, ProgramCache& cache,
                                                 const KernelConfig& config,
                                                 std::span<const PixelLattice> lattices,
                                                 const MaterialParams& material,
                                                 const glm::dvec2& half_slope,
                                                 const std::optional<Buffer>& table = {});

}  // namespace glintmark
