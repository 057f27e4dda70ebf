// Attributes of covered pixels, written to their planes.
#pragma once
#include <cstdint>

#include "host/core/planes.h"
#include "host/raster/attribute_table.h"
#include "host/raster/tile_pixels.h"

namespace glintmark {

/// Evaluates pixels [first, first + count) of `pixels` and writes them to entries [entry, entry +
/// count) of every plane of `out`.
void writeAttributes(const AttributeTable& table, const TilePixels& pixels, std::uint32_t first,
                     std::uint32_t count, std::size_t entry, const PixelPlanes& out);

}  // namespace glintmark
