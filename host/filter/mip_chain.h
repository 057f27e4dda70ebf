// Mip chains of any size and channel count.
#pragma once
#include <cstddef>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// Levels from the finest (0) to 1x1. Level l has max(1, w >> l) x max(1, h >> l) texels; each is
/// the area-weighted mean of the finest texels that it covers, so every level has the finest
/// level's mean.
struct MipChain {
  std::vector<Image> levels;
};

/// Number of levels of a w x h map, both at least 1.
int mipLevelCount(int width_px, int height_px);

/// Texels in memory, row by row, `stride` floats from one to the next.
template <typename Float>
struct TexelGrid {
  Float* texels;
  int width, height;
  std::size_t stride;

  Float* at(int x, int y) const {
    return texels + (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)) *
                        stride;
  }
};

/// Area-weighted means of the first `channels` floats of `fine`, of at least as many texels each
/// way, in double precision.
void reduceTexels(const TexelGrid<const float>& fine, const TexelGrid<float>& coarse, int channels);

/// Whether a level's texels consist of whole texels of the level `below` it, and those of whole
/// texels of the `top` one, along one axis: then its means may come from the level below, at a
/// fraction of the work.
bool levelsNest(int top, int below, int level);

/// Builds the chain in double precision per texel. Throws Error for an empty image.
MipChain makeMipChain(Image finest);

/// The finest texels [first, first + weights.size()) that texel `x` of `coarse` texels covers along
/// one axis of `fine` texels, with the share of each that is covered, in (0, 1].
struct MipCover {
  int first = 0;
  std::vector<float> weights;
};
MipCover mipCover(int x, int coarse, int fine);

}  // namespace glintmark
