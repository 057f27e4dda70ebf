#include "host/filter/mip_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "host/core/error.h"
#include "host/filter/all_rows.h"

namespace glintmark {
namespace {

constexpr std::size_t kPieceTexels = 65536;

}  // namespace

int MipTexels::levelWidth(int level) const {
  return std::max(1, static_cast<int>(layout.width >> level));
}

int MipTexels::levelHeight(int level) const {
  return std::max(1, static_cast<int>(layout.height >> level));
}

const float4* MipTexels::at(int level, int x, int y) const {
  const std::size_t texel =
      layout.first[level] + static_cast<std::size_t>(y) * levelWidth(level) + x;
  return texels.data() + texel * vectors;
}

float4* MipTexels::at(int level, int x, int y) {
  return const_cast<float4*>(std::as_const(*this).at(level, x, y));
}

MipTexture makeMipTexture(int width_px, int height_px) {
  MipTexture layout{};
  layout.width = static_cast<uint>(width_px);
  layout.height = static_cast<uint>(height_px);
  layout.level_count = static_cast<uint>(mipLevelCount(width_px, height_px));
  if (layout.level_count > GM_MAX_MIP_LEVELS) {
    throw Error(fmt::format("a texture of {}x{} texels is too large; it has at most {} per side",
                            width_px, height_px, 1u << (GM_MAX_MIP_LEVELS - 1)));
  }
  uint next = 0;
  for (uint level = 0; level < layout.level_count; ++level) {
    layout.first[level] = next;
    next += std::max(1u, layout.width >> level) * std::max(1u, layout.height >> level);
  }
  return layout;
}

MipTexels makeMipTexels(int width_px, int height_px, int vectors) {
  MipTexels result{makeMipTexture(width_px, height_px), vectors, {}};
  const int last = static_cast<int>(result.layout.level_count) - 1;
  result.texels.resize((result.layout.first[last] + std::size_t{1}) * vectors);
  // On all threads: the first to touch a page waits for it.
  const std::size_t count = result.texels.size();
  const auto pieces = static_cast<int>((count + kPieceTexels - 1) / kPieceTexels);
  forAllRows(pieces, "a mip chain's memory", [&](int piece) {
    const std::size_t first = static_cast<std::size_t>(piece) * kPieceTexels;
    float4* const texels = result.texels.data() + first;
    std::fill(texels, texels + std::min(kPieceTexels, count - first), float4{});
  });
  return result;
}

void fillCoarserLevels(MipTexels& chain, int channels) {
  const std::size_t stride = std::size_t{4} * static_cast<std::size_t>(chain.vectors);
  const auto floats = [&](int level) { return &chain.at(level, 0, 0)->x; };
  const int width = chain.levelWidth(0), height = chain.levelHeight(0);
  for (int level = 1; level < static_cast<int>(chain.layout.level_count); ++level) {
    const TexelGrid<float> coarse{floats(level), chain.levelWidth(level), chain.levelHeight(level),
                                  stride};
    const bool nests = levelsNest(width, chain.levelWidth(level - 1), coarse.width) &&
                       levelsNest(height, chain.levelHeight(level - 1), coarse.height);
    const int from = nests ? level - 1 : 0;
    reduceTexels({floats(from), chain.levelWidth(from), chain.levelHeight(from), stride}, coarse,
                 channels);
  }
}

void fillLevel(MipTexels& chain, int level, const Image& image) {
  const int channels = std::min(image.channels, 4 * chain.vectors);
  float* to = &chain.at(level, 0, 0)->x;
  for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels)) {
    std::copy_n(image.pixels.data() + i, channels, to);
    to += std::ptrdiff_t{4} * chain.vectors;
  }
}

MipTexels packMipChain(const MipChain& chain, int vectors) {
  const Image& finest = chain.levels.front();
  MipTexels result = makeMipTexels(finest.width, finest.height, vectors);
  for (std::size_t level = 0; level < chain.levels.size(); ++level)
    fillLevel(result, static_cast<int>(level), chain.levels[level]);
  return result;
}

}  // namespace glintmark
