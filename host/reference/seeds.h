// Seeds of the glint draws, steps 3 to 7 of "The draws" in kernels/README.md.
#pragma once
#include <cstdint>

namespace glintmark::reference {

/// Step 3: i >> trailingZeros(i), 0 for 0; the same for i and 2 i. [ZK16] Sect. 4.1
std::int32_t coherentIndex(std::int32_t i);

/// Step 4: seed of a texture cell, from plain (not yet coherent) indices.
std::uint32_t cellSeed(std::int32_t cell_u, std::int32_t cell_v);

/// Half vector in cells of its own grid, 16.16 fixed point.
struct HalfVectorIndex {
  std::int32_t u = 0, v = 0;
};

/// Steps 5 and 6: the half vector's cell, shifted at random per texture cell, and the pair's seed.
std::uint32_t pairSeed(std::uint32_t cell_seed, HalfVectorIndex half);

/// U(h) = (h + 1/2) / 2^32.
double uniformOf(std::uint32_t h);

/// Step 7's g: about standard normal, within +-3.45.
double gaussOf(std::uint32_t h);

/// What one pair of cells holds.
struct CellContent {
  std::int64_t count = 1;  // N >= 1
  double draw = 0;         // U(d) of the binomial draw
};

/// Step 7: number of microdetails for the pair seed `d`, expected number `mean` at most
/// 2^30 / (1 + 3.5 v).
CellContent cellContent(std::uint32_t d, double mean, double size_variation);

}  // namespace glintmark::reference
