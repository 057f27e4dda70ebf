#include "host/filter/normal_moments.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>

#include "host/core/free_memory.h"
#include "host/filter/all_rows.h"
#include "host/filter/interpolated_normals.h"
#include "host/filter/mip_chain.h"

namespace glintmark {
namespace {

std::string chainOf(const NormalMap& map) {
  return fmt::format("the mip chain of map '{}'", map.name);
}

// Of every texel, `stride` floats apart.
template <class Channels>
void writeMoments(const NormalMap& map, float* to, std::size_t stride, const Channels& write) {
  const auto width = static_cast<std::size_t>(map.width_px);
  forAllRows(map.height_px, chainOf(map), [&](int y) {
    const std::size_t first = static_cast<std::size_t>(y) * width;
    for (std::size_t i = first; i < first + width; ++i) write(map.normals[i], to + i * stride);
  });
}

template <class Channels>
Image moments(const NormalMap& map, int channels, const Channels& write) {
  Image image(map.width_px, map.height_px, channels);
  writeMoments(map, image.pixels.data(), static_cast<std::size_t>(channels), write);
  return image;
}

// Floats of the moments that are so many float4.
constexpr int channelsOf(int vectors) {
  return vectors == 1 ? 3 : 5;
}

bool isPowerOfTwo(int size) {
  return std::has_single_bit(static_cast<unsigned>(size));
}

// Means over the map's texels of what lies between them. Where sides are powers of two, the levels
// of this are those of the interpolated map but its finest, which is held a few rows at a time.
template <class Channels>
Image meansOfSurface(const NormalMap& map, int channels, const Channels& write) {
  constexpr int kRowsAtOnce = 64;
  Image means(map.width_px, map.height_px, channels);
  const auto stride = static_cast<std::size_t>(channels);
  const int bands = (map.height_px + kRowsAtOnce - 1) / kRowsAtOnce;
  forAllRows(bands, chainOf(map), [&](int band) {
    const int y = band * kRowsAtOnce, rows = std::min(kRowsAtOnce, map.height_px - y);
    const Image fine =
        moments(interpolatedRows(map, kSurfaceSamples, kSurfaceSamples * y, kSurfaceSamples * rows),
                channels, write);
    reduceTexels({fine.pixels.data(), fine.width, fine.height, stride},
                 {means.at(0, y).data(), means.width, rows, stride}, channels);
  });
  return means;
}

// The finest level is that of the map's texels, coarser ones are means of what lies between them
// too, if wanted.
template <class Channels>
MipTexels mipMoments(const NormalMap& map, bool between_texels, int vectors,
                     const Channels& write) {
  checkNormalMap(map);
  const int channels = channelsOf(vectors);
  const bool finer = between_texels && canInterpolate(map);
  const bool in_rows = isPowerOfTwo(map.width_px) && isPowerOfTwo(map.height_px);
  requireMemory(momentBytes(map.width_px, map.height_px, vectors, finer), chainOf(map));
  MipTexels chain = makeMipTexels(map.width_px, map.height_px, vectors);
  writeMoments(map, &chain.texels.data()->x, std::size_t{4} * static_cast<std::size_t>(vectors),
               write);
  if (!finer) {
    fillCoarserLevels(chain, channels);
    return chain;
  }
  const MipChain surface =
      makeMipChain(in_rows ? meansOfSurface(map, channels, write)
                           : moments(interpolatedNormals(map, kSurfaceSamples), channels, write));
  const std::size_t skipped = in_rows ? 0 : 1;
  for (int level = 1; level < static_cast<int>(chain.layout.level_count); ++level)
    fillLevel(chain, level, surface.levels[static_cast<std::size_t>(level) + skipped]);
  return chain;
}

}  // namespace

std::uint64_t momentBytes(int width_px, int height_px, int vectors, bool between) {
  const bool in_rows = isPowerOfTwo(width_px) && isPowerOfTwo(height_px);
  // The packed texels, and of the surface its means and what they are made of.
  const int channels = channelsOf(vectors);
  const int floats = 4 * vectors + (!between ? 0 : in_rows ? channels : 4 * (channels + 3));
  return static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px) *
         sizeof(float) * static_cast<std::uint64_t>(floats) * 4 / 3;
}

MipTexels meanNormals(const NormalMap& map, bool between) {
  return mipMoments(map, between, 1,
                    [](const glm::vec3& n, float* to) { to[0] = n.x, to[1] = n.y, to[2] = n.z; });
}

MipTexels leanMoments(const NormalMap& map) {
  return mipMoments(map, true, 2, [](const glm::vec3& n, float* to) {
    glm::vec2 slope = glm::vec2(n) / n.z;
    slope *= std::min(1.0f, kMaxLeanSlope / std::max(glm::length(slope), 1e-20f));
    to[0] = slope.x, to[1] = slope.y, to[2] = slope.x * slope.x, to[3] = slope.y * slope.y;
    to[4] = slope.x * slope.y;
  });
}

}  // namespace glintmark
