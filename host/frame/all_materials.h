// What a program for all materials of a scene reads in place of one material's own buffers.
#pragma once
#include <cstdint>
#include <vector>

#include "host/core/planes.h"
#include "host/frame/frame_renderer.h"
#include "host/ocl/compute.h"

namespace glintmark {

/// Arrays with one element for each material of the scene.
struct MaterialArrays {
  Buffer materials, scatter;
  Buffer map_layouts, map_texels;
};

/// Makes and uploads them for `config`, which configForAll() gave. Throws Error if the scene has
/// more than one normal map: their texels would have to share a buffer.
MaterialArrays uploadMaterialArrays(Device& device, const Scene& scene,
                                    const ShadingOptions& options, const KernelConfig& config,
                                    NormalTextures& textures);

/// The material of every entry of the planes, padding included.
std::vector<std::uint32_t> entryOwners(const PixelPlanes& planes);

/// The same pixels as one list in the order of the screen, square tiles of the rasterizer from left
/// to right and down, rows within them; `owners` is reordered likewise. The list's material is 0.
PixelPlanes inScreenOrder(const PixelPlanes& planes, std::vector<std::uint32_t>& owners);

}  // namespace glintmark
