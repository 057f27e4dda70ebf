#include "host/filter/normal_moments.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/free_memory.h"
#include "host/filter/interpolated_normals.h"

namespace glintmark {
namespace {

template <class Channels>
MipChain momentChain(const NormalMap& map, int channels, const Channels& write) {
  Image finest(map.width_px, map.height_px, channels);
  for (std::size_t i = 0; i < map.normals.size(); ++i) {
    write(map.normals[i], finest.pixels.data() + i * channels);
  }
  return makeMipChain(std::move(finest));
}

// The finest level is that of the map's texels, coarser ones are means of what lies between them
// too, if wanted.
template <class Channels>
MipTexels mipMoments(const NormalMap& map, bool between_texels, int channels, int vectors,
                     const Channels& write) {
  checkNormalMap(map);
  // Both chains, the image that the finer one comes from, and the packed texels.
  const bool finer = between_texels && canInterpolate(map);
  const std::size_t texels = map.normals.size() * (finer ? kSurfaceSamples * kSurfaceSamples : 1);
  requireMemory(texels * sizeof(float) * (channels + (finer ? 3 : vectors * 4)) * 4 / 3,
                fmt::format("the mip chain of map '{}'", map.name));
  MipChain chain = momentChain(map, channels, write);
  if (finer) {
    MipChain between = momentChain(interpolatedNormals(map, kSurfaceSamples), channels, write);
    for (std::size_t level = 1; level < chain.levels.size(); ++level)
      chain.levels[level] = std::move(between.levels[level + 1]);
  }
  return packMipChain(chain, vectors);
}

}  // namespace

MipTexels meanNormals(const NormalMap& map, bool between) {
  return mipMoments(map, between, 3, 1,
                    [](const glm::vec3& n, float* to) { to[0] = n.x, to[1] = n.y, to[2] = n.z; });
}

MipTexels leanMoments(const NormalMap& map) {
  return mipMoments(map, true, 5, 2, [](const glm::vec3& n, float* to) {
    glm::vec2 slope = glm::vec2(n) / n.z;
    slope *= std::min(1.0f, kMaxLeanSlope / std::max(glm::length(slope), 1e-20f));
    to[0] = slope.x, to[1] = slope.y, to[2] = slope.x * slope.x, to[3] = slope.y * slope.y;
    to[4] = slope.x * slope.y;
  });
}

}  // namespace glintmark
