// Depth test of one tile: which entry of the tile's list is nearest at each pixel?
#pragma once
#include <cstdint>

#include "host/raster/binning.h"

namespace glintmark {

/// Value of a pixel that no triangle covers.
inline constexpr std::uint32_t kNoEntry = 0xFFFFFFFFu;

/// Writes for the kTilePixels pixels of `tile`, row by row, the position of the nearest triangle in
/// bins.entries(tile), or kNoEntry. Of two triangles at the same depth the lower index wins.
/// Pixels of border tiles that lie outside the image are kNoEntry. Returns the pixels covered.
std::uint32_t rasterizeTile(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                            std::uint32_t* nearest);

}  // namespace glintmark
