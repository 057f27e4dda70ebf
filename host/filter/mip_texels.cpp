#include "host/filter/mip_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "host/core/error.h"

namespace glintmark {

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
  return result;
}

MipTexels packMipChain(const MipChain& chain, int vectors) {
  const Image& finest = chain.levels.front();
  MipTexels result = makeMipTexels(finest.width, finest.height, vectors);
  const int channels = std::min(finest.channels, 4 * vectors);
  for (std::size_t level = 0; level < chain.levels.size(); ++level) {
    const Image& image = chain.levels[level];
    float4* to = result.at(static_cast<int>(level), 0, 0);
    const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
    for (std::size_t i = 0; i < count; ++i) {
      for (int c = 0; c < channels; ++c) {
        float4& v = to[i * vectors + c / 4];
        (c % 4 == 0   ? v.x
         : c % 4 == 1 ? v.y
         : c % 4 == 2 ? v.z
                      : v.w) = image.pixels[i * image.channels + c];
      }
    }
  }
  return result;
}

}  // namespace glintmark
