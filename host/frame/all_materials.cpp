#include "host/frame/all_materials.h"

#include <algorithm>

#include "host/core/glint_grids.h"
#include "host/frame/effects.h"
#include "host/frame/specular_albedo.h"
#include "host/ocl/upload.h"
#include "host/raster/projection.h"

namespace glintmark {

MaterialParams preparedMaterial(const Material& material, const KernelConfig& config) {
  MaterialParams params = withGlintGrids(material.params);
  if (config.albedo_scaling) setSpecularAlbedo(params.surface, material.ggx);
  return params;
}

Buffer uploadMaterials(Device& device, const Scene& scene, const ShadingOptions& options,
                       int lanes) {
  std::vector<MaterialParams> materials;
  for (const Material& material : scene.materials) {
    const KernelConfig config = configFor(material, scene, options, lanes);
    materials.push_back(preparedMaterial(material, config));
    materials.back().surface.effects = effectBits(config);
  }
  return upload(device, materials, BufferPurpose::kMaterials);
}

std::vector<std::uint32_t> entryOwners(const PixelPlanes& planes) {
  std::vector<std::uint32_t> owners(planes.stride, 0);
  for (std::size_t i = 0; i < planes.lists.size(); ++i) {
    const std::size_t end =
        i + 1 < planes.lists.size() ? planes.lists[i + 1].offset : planes.stride;
    std::fill(owners.begin() + planes.lists[i].offset,
              owners.begin() + static_cast<std::ptrdiff_t>(end), planes.lists[i].material);
  }
  return owners;
}

PixelPlanes inScreenOrder(const PixelPlanes& planes, std::vector<std::uint32_t>& owners) {
  PixelPlanes out;
  out.width_px = planes.width_px;
  out.height_px = planes.height_px;
  out.mask = planes.mask;
  out.covered_px = planes.covered_px;
  if (planes.covered_px == 0) return out;
  std::vector<std::uint32_t> entries;
  entries.reserve(planes.stride);
  for (const PixelList& list : planes.lists)
    for (std::uint32_t i = 0; i < list.count; ++i) entries.push_back(list.offset + i);
  const auto pixel = planes.plane(Plane::kPixel);
  const auto place = [&](std::uint32_t entry) {
    constexpr std::uint64_t kTile = kTileSize_px;
    const std::uint64_t x = pixel[entry] & 0xFFFFu, y = pixel[entry] >> 16;
    return (y / kTile) << 48 | (x / kTile) << 32 | (y % kTile) << 16 | x % kTile;
  };
  std::ranges::sort(entries, {}, place);
  out.lists = {{0, 0, static_cast<std::uint32_t>(entries.size())}};
  entries.resize((entries.size() + GM_LIST_PADDING - 1) / GM_LIST_PADDING * GM_LIST_PADDING,
                 entries.back());

  out.stride = entries.size();
  out.storage.reserve(out.stride * out.mask.size());
  for (std::size_t slot = 0; slot < out.mask.size(); ++slot) {
    const std::uint32_t* from = planes.storage.data() + slot * planes.stride;
    std::uint32_t* to = out.storage.data() + slot * out.stride;
    for (std::size_t i = 0; i < entries.size(); ++i) to[i] = from[entries[i]];
  }
  std::vector<std::uint32_t> reordered(entries.size());
  std::ranges::transform(entries, reordered.begin(),
                         [&](std::uint32_t entry) { return owners[entry]; });
  owners = std::move(reordered);
  return out;
}

}  // namespace glintmark
