#include "host/raster/tile_pixels.h"

#include <algorithm>

#include "host/raster/tile_visibility.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "host/raster/tile_pixels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using I32 = hn::ScalableTag<std::int32_t>;
using VI = hn::Vec<I32>;

// Marks the entries that some pixel sees; kNoEntry marks the element past the end.
void markSeen(const std::uint32_t* HWY_RESTRICT nearest, std::uint32_t entry_count,
              std::uint8_t* HWY_RESTRICT seen) {
  const I32 di;
  for (int i = 0; i < kTilePixels; i += static_cast<int>(hn::Lanes(di))) {
    const VI v = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(nearest) + i);
    if (hn::AllTrue(di, hn::Eq(v, hn::Set(di, static_cast<std::int32_t>(nearest[i]))))) {
      seen[std::min(nearest[i], entry_count)] = 1;
      continue;
    }
    for (std::size_t lane = 0; lane < hn::Lanes(di); ++lane)
      seen[std::min(nearest[static_cast<std::size_t>(i) + lane], entry_count)] = 1;
  }
}

// Appends the tile's pixels of one material, or with kAll all covered ones; returns the new count.
template <bool kAll>
HWY_INLINE std::uint32_t appendPixels(const std::uint32_t* HWY_RESTRICT nearest,
                                      std::int32_t first_pixel, std::int32_t material,
                                      std::uint32_t count, TilePixels& out) {
  const I32 di;
  const auto* entries = reinterpret_cast<const std::int32_t*>(nearest);
  const auto* slot_of_entry = reinterpret_cast<const std::int32_t*>(out.slot_of_entry.data());
  const auto* materials = reinterpret_cast<const std::int32_t*>(out.slot_materials);
  auto* slots = reinterpret_cast<std::int32_t*>(out.slots);
  auto* pixels = reinterpret_cast<std::int32_t*>(out.pixels);
  const VI none = hn::Set(di, static_cast<std::int32_t>(kNoEntry));
  for (int y = 0; y < kTileSize_px; ++y)
    for (int x = 0; x < kTileSize_px; x += static_cast<int>(hn::Lanes(di))) {
      const VI entry = hn::LoadU(di, entries + y * kTileSize_px + x);
      auto wanted = hn::Ne(entry, none);
      if (hn::AllFalse(di, wanted)) continue;
      const VI slot = hn::GatherIndex(di, slot_of_entry, hn::IfThenElseZero(wanted, entry));
      if constexpr (!kAll)
        wanted =
            hn::And(wanted, hn::Eq(hn::GatherIndex(di, materials, slot), hn::Set(di, material)));
      const VI pixel = hn::Add(hn::Iota(di, 0), hn::Set(di, first_pixel + (y << 16) + x));
      if (hn::AllTrue(di, wanted)) {
        hn::StoreU(slot, di, slots + count);
        hn::StoreU(pixel, di, pixels + count);
        count += static_cast<std::uint32_t>(hn::Lanes(di));
      } else {
        hn::CompressStore(slot, wanted, di, slots + count);
        count += static_cast<std::uint32_t>(hn::CompressStore(pixel, wanted, di, pixels + count));
      }
    }
  return count;
}

std::uint32_t appendMaterial(const std::uint32_t* nearest, std::int32_t first_pixel,
                             std::int32_t material, std::uint32_t count, bool all,
                             TilePixels& out) {
  return all ? appendPixels<true>(nearest, first_pixel, material, count, out)
             : appendPixels<false>(nearest, first_pixel, material, count, out);
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glintmark {

HWY_EXPORT(markSeen);
HWY_EXPORT(appendMaterial);

namespace {

// Gives every triangle seen in the tile a slot, in the order of the list.
void assignSlots(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                 const std::uint32_t* nearest, TilePixels& out) {
  const std::span<const std::uint32_t> entries = bins.entries(tile);
  out.seen.assign(entries.size() + 1, 0);
  if (out.slot_of_entry.size() < entries.size()) out.slot_of_entry.resize(entries.size());
  HWY_DYNAMIC_DISPATCH(markSeen)
  (nearest, static_cast<std::uint32_t>(entries.size()), out.seen.data());

  std::uint32_t slot = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!out.seen[i]) continue;
    out.slot_of_entry[i] = slot;
    out.triangles[slot] = bins.triangle(entries[i]);
    out.slot_materials[slot] = mesh.mesh->triangle_materials[out.triangles[slot]];
    ++slot;
  }
  out.triangle_count = slot;
  // What a SIMD batch reads beyond the end must be triangles too.
  if (slot > 0) std::fill_n(out.triangles + slot, kListSlack, out.triangles[slot - 1]);
}

void findMaterials(TilePixels& out) {
  out.runs.clear();
  for (std::uint32_t i = 0; i < out.triangle_count; ++i) {
    const std::uint32_t material = out.slot_materials[i];
    if (!out.runs.empty() && out.runs.back().material == material) continue;
    const auto at =
        std::lower_bound(out.runs.begin(), out.runs.end(), material,
                         [](const MaterialRun& run, std::uint32_t m) { return run.material < m; });
    if (at == out.runs.end() || at->material != material) out.runs.insert(at, {material});
  }
}

}  // namespace

void collectTilePixels(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                       const std::uint32_t* nearest, TilePixels& out) {
  assignSlots(mesh, bins, tile, nearest, out);
  findMaterials(out);
  const auto tiles_x = static_cast<std::size_t>(mesh.projection->tiles_x);
  const auto x0 = static_cast<std::int32_t>(tile % tiles_x * kTileSize_px);
  const auto y0 = static_cast<std::int32_t>(tile / tiles_x * kTileSize_px);

  std::uint32_t n = 0;
  for (MaterialRun& run : out.runs) {
    run.first = n;
    n = HWY_DYNAMIC_DISPATCH(appendMaterial)(nearest, (y0 << 16) + x0,
                                             static_cast<std::int32_t>(run.material), n,
                                             out.runs.size() == 1, out);
    run.count = n - run.first;
  }
  out.pixel_count = n;
  if (n == 0) return;
  std::fill_n(out.slots + n, kListSlack, out.slots[n - 1]);
  std::fill_n(out.pixels + n, kListSlack, out.pixels[n - 1]);
}

void countTileMaterials(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                        const std::uint32_t* nearest, std::uint32_t* counts) {
  const std::span<const std::uint32_t> entries = bins.entries(tile);
  std::uint32_t last = kNoEntry, material = 0;
  for (int i = 0; i < kTilePixels; ++i) {
    if (nearest[i] == kNoEntry) continue;
    if (nearest[i] != last) {
      last = nearest[i];
      material = mesh.mesh->triangle_materials[bins.triangle(entries[last])];
    }
    ++counts[material];
  }
}

}  // namespace glintmark
#endif
