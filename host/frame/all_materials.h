// What a program for all materials of a scene reads in place of one material's, and the order of
// its pixels.
#pragma once
#include <cstdint>
#include <vector>

#include "host/core/planes.h"
#include "host/frame/shading_options.h"
#include "host/ocl/compute.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// One material as a program of `config` reads it: grids of glints and albedos set from the rest.
MaterialParams preparedMaterial(const Material& material, const KernelConfig& config);

/// The materials of the scene as an array, each with the effects of its own program.
Buffer uploadMaterials(Device& device, const Scene& scene, const ShadingOptions& options,
                       int lanes);

/// The material of every entry of the planes, padding included.
std::vector<std::uint32_t> entryOwners(const PixelPlanes& planes);

/// The same pixels as one list in the order of the screen, square tiles of the rasterizer from left
/// to right and down, rows within them; `owners` is reordered likewise. The list's material is 0.
PixelPlanes inScreenOrder(const PixelPlanes& planes, std::vector<std::uint32_t>& owners);

}  // namespace glintmark
