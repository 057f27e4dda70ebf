#include "host/frame/all_materials.h"

#include <algorithm>

#include "host/core/error.h"
#include "host/frame/effect/multiscatter.h"
#include "host/frame/effects.h"
#include "host/raster/projection.h"

namespace glintmark {
namespace {

template <typename T>
Buffer upload(Device& device, const std::vector<T>& items, const std::string& what) {
  Buffer buffer(device, items.size() * sizeof(T), what);
  buffer.write(items.data(), items.size() * sizeof(T));
  return buffer;
}

// Layouts of all materials and the one texture that they share; without any, room that nobody
// reads.
void uploadMap(Device& device, const Scene& scene, const ShadingOptions& options,
               const KernelConfig& config, NormalTextures& textures, MaterialArrays& arrays) {
  std::vector<MipTexture> layouts(scene.materials.size());
  std::shared_ptr<const NormalMap> map;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const auto& source = scene.materials[i].normal_map;
    if (!source) continue;
    if (map && map != source->map)
      throw Error("one program for all materials needs one normal map; the scene has several");
    map = source->map;
    textures.get(map, config, options.mixture_order, options.mixture_iterations)
        .layout.read(&layouts[i], sizeof(MipTexture));
  }
  arrays.map_layouts = upload(device, layouts, "the layouts of all normal maps");
  arrays.map_texels =
      map ? textures.get(map, config, options.mixture_order, options.mixture_iterations).texels
          : Buffer(device, sizeof(float4), "no normal map");
}

}  // namespace

MaterialArrays uploadMaterialArrays(Device& device, const Scene& scene,
                                    const ShadingOptions& options, const KernelConfig& config,
                                    NormalTextures& textures) {
  MaterialArrays arrays;
  std::vector<MaterialParams> materials;
  std::vector<MultiscatterMaterial> scatter;
  for (const Material& material : scene.materials) {
    const KernelConfig own = configFor(material, scene, options, config.width);
    materials.push_back(material.params);
    materials.back().surface.effects = effectBits(own);
    scatter.push_back(prepareMultiscatter(material, own));
  }
  arrays.materials = upload(device, materials, "all materials");
  arrays.scatter = upload(device, scatter, "the scattering of all materials");
  uploadMap(device, scene, options, config, textures, arrays);
  return arrays;
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
  std::vector<std::uint32_t> reordered;
  for (const std::uint32_t entry : entries) reordered.push_back(owners[entry]);
  owners = std::move(reordered);
  return out;
}

}  // namespace glintmark
