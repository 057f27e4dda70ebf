// Mip chains of any size and channel count.
#pragma once
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
