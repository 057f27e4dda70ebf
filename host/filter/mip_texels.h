// Mip chains as the kernels read them: one buffer of float4, level after level.
#pragma once
#include "host/core/large_array.h"
#include "host/core/shared_types.h"
#include "host/filter/mip_chain.h"

namespace glintmark {

/// A texel is `vectors` consecutive float4; texel t of the chain starts at texels[t * vectors] and
/// texel (x, y) of level l is t = layout.first[l] + y * max(1, width >> l) + x.
struct MipTexels {
  MipTexture layout{};
  int vectors = 1;
  LargeArray<float4> texels;

  int levelWidth(int level) const;
  int levelHeight(int level) const;
  std::size_t texelCount() const { return texels.size() / static_cast<std::size_t>(vectors); }
  /// First vector of texel (x, y) of `level`.
  float4* at(int level, int x, int y);
  const float4* at(int level, int x, int y) const;
};

/// The layout of a chain of width x height texels and all its levels.
MipTexture makeMipTexture(int width_px, int height_px);

/// Zeros in the layout of width x height texels of `vectors` float4.
MipTexels makeMipTexels(int width_px, int height_px, int vectors);

/// Makes every level after the finest from that, as makeMipChain() does, of the first `channels`
/// floats of a texel.
void fillCoarserLevels(MipTexels& chain, int channels);

/// Copies an image of a level's size into it; channels beyond those stay.
void fillLevel(MipTexels& chain, int level, const Image& image);

/// A mip chain of up to 4 * `vectors` channels, missing ones 0.
MipTexels packMipChain(const MipChain& chain, int vectors);

}  // namespace glintmark
