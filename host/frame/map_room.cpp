#include "host/frame/map_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/frame/effect/normal_maps.h"
#include "host/frame/effects.h"
#include "host/ocl/switches.h"

namespace glintmark {
namespace {

// Below this nobody is asked.
constexpr std::uint64_t kSmall_bytes = std::uint64_t{128} << 20;

double inGb(std::uint64_t bytes) {
  return static_cast<double>(bytes) * 1e-9;
}

std::string describe(const NormalMap& map, const KernelConfig& config) {
  std::string method = choiceName(config.normal_method);
  if (readsMixture(config.normal_method)) method += fmt::format(" with {} lobes", config.lobes);
  return fmt::format("normal map '{}' of {}x{} texels, shown by normal method {},", map.name,
                     map.width_px, map.height_px, method);
}

// The side of a square map that takes no more than `limit` where this one takes `needed`.
int sideWithin(const NormalMap& map, std::uint64_t needed, std::uint64_t limit) {
  const double texels = static_cast<double>(map.width_px) * map.height_px;
  return static_cast<int>(
      std::sqrt(texels * static_cast<double>(limit) / static_cast<double>(needed)));
}

// What would do: fewer texels, or the method of least.
std::string remedy(const NormalMap& map, const KernelConfig& config, std::uint64_t needed,
                   std::uint64_t limit, std::uint64_t TextureNeed::*what, std::uint64_t beside) {
  const int side = sideWithin(map, needed, limit);
  std::string text = fmt::format("give the map at most {}x{} texels", side, side);
  KernelConfig least = config;
  least.normal_method = NormalMethod::kToksvig;
  const std::uint64_t other = textureNeed(map.width_px, map.height_px, least).*what + beside;
  if (config.normal_method != NormalMethod::kToksvig && other < needed && other <= limit)
    text += fmt::format(", or choose normal method toksvig, which needs {:.1f} GB", inGb(other));
  return text;
}

void requireBuffer(const NormalMap& map, const KernelConfig& config, const TextureNeed& need,
                   const std::function<DeviceInfo()>& device) {
  if (need.buffer_bytes < kSmall_bytes) return;
  const DeviceInfo info = device();
  if (info.max_alloc_bytes == 0 || need.buffer_bytes <= info.max_alloc_bytes) return;
  throw Error(fmt::format(
      "{} needs {:.1f} GB in one buffer, but '{}' allows at most {:.1f} GB; {}",
      describe(map, config), inGb(need.buffer_bytes), info.name, inGb(info.max_alloc_bytes),
      remedy(map, config, need.buffer_bytes, info.max_alloc_bytes, &TextureNeed::buffer_bytes, 0)));
}

// A map of the scene with what it takes.
struct MapNeed {
  const NormalMap* map;
  KernelConfig config;
  TextureNeed texture;
};

}  // namespace

void requireRoomForMaps(const Scene& scene, const ShadingOptions& options, bool truth,
                        const std::function<DeviceInfo()>& device) {
  std::vector<MapNeed> needs;
  std::uint64_t kept = 0;  // maps, and textures where they lie in the same memory
  std::set<const NormalMap*> seen;
  for (const Material& material : scene.materials) {
    if (!material.normal_map || material.normal_map->map->width_px < 1) continue;
    const NormalMap& map = *material.normal_map->map;
    const int lanes = std::max(1, options.lanes);
    const KernelConfig config = truth ? truthConfigFor(material, scene, options, lanes)
                                      : configFor(material, scene, options, lanes);
    if (!config.normal_map) continue;
    needs.push_back({&map, config, textureNeed(map.width_px, map.height_px, config)});
    if (seen.insert(&map).second) kept += normalMapBytes(map.width_px, map.height_px, true);
    kept += needs.back().texture.buffer_bytes;
  }
  std::uint64_t free_bytes = 0;
  for (const MapNeed& need : needs) {
    requireBuffer(*need.map, need.config, need.texture, device);
    const std::uint64_t needed = kept + need.texture.host_bytes - need.texture.buffer_bytes;
    if (needed < kSmall_bytes) continue;
    if (free_bytes == 0) free_bytes = freeMemoryBytes();
    if (free_bytes == 0 || needed <= free_bytes) continue;
    throw Error(fmt::format("{} needs about {:.1f} GB of memory, but {:.1f} GB are free; {}",
                            describe(*need.map, need.config), inGb(needed), inGb(free_bytes),
                            remedy(*need.map, need.config, needed, free_bytes,
                                   &TextureNeed::host_bytes, needed - need.texture.host_bytes)));
  }
}

}  // namespace glintmark
