// Primary rays of a camera through Embree, in its three fast ways, parallel over 32 x 32 px tiles.
#pragma once
#include <cstdint>
#include <vector>

#include "tests/raster/embree_oracle.h"

namespace glintmark::bench {

enum class RayMode { kSingle, kPacket16, kStream };

/// First triangle per pixel, row by row, kNoTriangle where there is none.
void traceEmbree(const test::EmbreeOracle& oracle, const Camera& camera, RayMode mode,
                 std::vector<std::uint32_t>& triangle_ids);

}  // namespace glintmark::bench
