// Seeds of the glint draws, steps 3 to 7 of "The draws" in kernels/README.md.
#pragma once
#include <cstdint>

namespace glintmark::reference {

/// Step 3: i >> trailingZeros(i), 0 for 0; the same for i and 2 i. [ZK16] Sect. 4.1
std::int32_t coherentIndex(std::int32_t i);

/// Step 4: seed of a texture cell, from plain (not yet coherent) indices, of more than 32 bits too.
std::uint32_t cellSeed(std::int64_t cell_u, std::int64_t cell_v, std::uint32_t salt = 0);

/// The same of indices as they are: step 3 left out.
std::uint32_t plainCellSeed(std::int64_t cell_u, std::int64_t cell_v, std::uint32_t salt = 0);

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
/// Step 7, for the pair seed `d`: m, the factor on a cell's number of microdetails.
double sizeFactor(std::uint32_t d, double size_variation);
/// The most that the expected number may be, before that factor.
double mostExpected(double size_variation);
/// `expected` rounded up or down at random.
std::int64_t wholeNumber(std::uint32_t d, double expected);

}  // namespace glintmark::reference
