// The covered pixels of one tile, grouped by material, and the triangles seen in it.
#pragma once
#include <cstdint>
#include <vector>

#include "host/raster/binning.h"

namespace glintmark {

/// Consecutive pixels of one material.
struct MaterialRun {
  std::uint32_t material = 0;
  std::uint32_t first = 0, count = 0;
};

/// Arrays have room for kListSlack more entries, which a SIMD batch may read.
struct TilePixels {
  static constexpr std::size_t kRoom = kTilePixels + kListSlack;
  std::uint32_t triangle_count = 0;
  std::uint32_t triangles[kRoom];  // slot -> triangle; a slot is a triangle seen in this tile
  std::uint32_t slot_materials[kRoom];
  std::uint32_t pixel_count = 0;
  std::uint32_t slots[kRoom];   // of each covered pixel
  std::uint32_t pixels[kRoom];  // y << 16 | x in the image
  std::vector<MaterialRun> runs;

  std::vector<std::uint8_t> seen;            // scratch: is this entry of the list seen?
  std::vector<std::uint32_t> slot_of_entry;  // scratch
};

/// Fills `out` from what rasterizeTile wrote. Within a material, pixels go row by row.
void collectTilePixels(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                       const std::uint32_t* nearest, TilePixels& out);

/// Adds the tile's covered pixels of each material to `counts`.
void countTileMaterials(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                        const std::uint32_t* nearest, std::uint32_t* counts);

}  // namespace glintmark
