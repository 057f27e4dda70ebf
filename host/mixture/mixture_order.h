// Which texels of a level are fitted together, and which neighbours each of them sees.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// Texels of a level that do not see each other: any order among them gives the same result.
struct TexelBatch {
  int count = 0;
  glm::ivec2 origin{0, 0};
  int per_row = 1;            // texels before the next row of the batch begins
  int step_x = 1;             // between neighbours in a row of the batch
  glm::ivec2 row_step{0, 1};  // between its rows

  glm::ivec2 at(int i) const {
    return origin + glm::ivec2((i % per_row) * step_x, 0) + (i / per_row) * row_step;
  }
};

/// The batches of a width x height level, to be fitted one after the other. For kScanline a batch
/// is one of the diagonals x + 2 y = constant: whatever a texel sees in the paper's serial order
/// lies on an earlier diagonal, so the result is the serial one, to the bit.
std::vector<TexelBatch> texelBatches(MixtureOrder order, int width, int height);

struct Neighbours {
  std::array<glm::ivec2, 8> texels;
  int count = 0;
};

/// Same-level neighbours of `texel` whose mixtures stand: in the first sweep those of earlier
/// texels, later all eight. With kColours the map repeats, but a neighbour in the own batch (across
/// the seam of an odd size) is left out; with kScanline, as in the paper, there is no seam.
Neighbours visibleNeighbours(MixtureOrder order, bool first_sweep, glm::ivec2 texel, int width,
                             int height);

}  // namespace glintmark
