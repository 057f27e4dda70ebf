#include "host/raster/tile_pixels.h"

#include <algorithm>

#include "host/raster/tile_visibility.h"

namespace glintmark {
namespace {

// Gives every triangle seen in the tile a slot, in the order of the list.
void assignSlots(const TileBins& bins, std::size_t tile, const std::uint32_t* nearest,
                 TilePixels& out) {
  const std::span<const std::uint32_t> entries = bins.entries(tile);
  out.seen.assign(entries.size() + 1, 0);
  if (out.slot_of_entry.size() < entries.size()) out.slot_of_entry.resize(entries.size());
  // Pixels without a triangle mark the element past the end.
  const auto none = static_cast<std::uint32_t>(entries.size());
  for (int i = 0; i < kTilePixels; ++i) out.seen[std::min(nearest[i], none)] = 1;

  std::uint32_t slot = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    out.slot_of_entry[i] = slot;
    out.triangles[slot] = bins.triangle(entries[i]);
    slot += out.seen[i];
  }
  out.triangle_count = slot;
  // What a SIMD batch reads beyond the end must be triangles too.
  if (slot > 0) std::fill_n(out.triangles + slot, kListSlack, out.triangles[slot - 1]);
}

void findMaterials(const TriangleMesh& mesh, TilePixels& out) {
  out.runs.clear();
  for (std::uint32_t i = 0; i < out.triangle_count; ++i) {
    const std::uint32_t material = mesh.triangle_materials[out.triangles[i]];
    const auto at =
        std::lower_bound(out.runs.begin(), out.runs.end(), material,
                         [](const MaterialRun& run, std::uint32_t m) { return run.material < m; });
    if (at == out.runs.end() || at->material != material) out.runs.insert(at, {material});
  }
}

}  // namespace

void collectTilePixels(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                       const std::uint32_t* nearest, TilePixels& out) {
  assignSlots(bins, tile, nearest, out);
  findMaterials(*mesh.mesh, out);
  const auto tiles_x = static_cast<std::size_t>(mesh.projection->tiles_x);
  const auto x0 = static_cast<std::uint32_t>(tile % tiles_x * kTileSize_px);
  const auto y0 = static_cast<std::uint32_t>(tile / tiles_x * kTileSize_px);

  std::uint32_t n = 0;
  for (MaterialRun& run : out.runs) {
    run.first = n;
    for (std::uint32_t i = 0; i < kTilePixels; ++i) {
      if (nearest[i] == kNoEntry) continue;
      const std::uint32_t slot = out.slot_of_entry[nearest[i]];
      out.slots[n] = slot;
      out.pixels[n] = (y0 + i / kTileSize_px) << 16 | (x0 + i % kTileSize_px);
      n += out.runs.size() == 1 ||
           mesh.mesh->triangle_materials[out.triangles[slot]] == run.material;
    }
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
