#include "host/filter/interpolated_normals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace glintmark {
namespace {

// The texels of a row (or column) of `count` around a fine texel, and the share of the second.
struct Neighbours {
  int low, high;
  float share;
};

Neighbours neighbours(int fine, int factor, int count) {
  const float position = (static_cast<float>(fine) + 0.5f) / static_cast<float>(factor) - 0.5f;
  const int below = static_cast<int>(std::floor(position));
  const float share = position - static_cast<float>(below);
  return {(below + count) % count, (below + 1) % count, share};
}

}  // namespace

NormalMap interpolatedNormals(const NormalMap& map, int factor) {
  return interpolatedRows(map, factor, 0, map.height_px * factor);
}

NormalMap interpolatedRows(const NormalMap& map, int factor, int first, int count) {
  NormalMap fine{map.name, map.width_px * factor, count, {}};
  fine.normals.resize(static_cast<std::size_t>(fine.width_px) * fine.height_px);
  tbb::parallel_for(0, count, [&](int y) {
    const Neighbours v = neighbours(first + y, factor, map.height_px);
    for (int x = 0; x < fine.width_px; ++x) {
      const Neighbours u = neighbours(x, factor, map.width_px);
      const glm::vec3 sum =
          glm::mix(glm::mix(map.at(u.low, v.low), map.at(u.high, v.low), u.share),
                   glm::mix(map.at(u.low, v.high), map.at(u.high, v.high), u.share), v.share);
      const float length = glm::length(sum);
      fine.normals[static_cast<std::size_t>(y) * fine.width_px + x] =
          length > 1e-6f ? sum / length : glm::vec3(0, 0, 1);
    }
  });
  return fine;
}

bool canInterpolate(int width_px, int height_px) {
  return kSurfaceSamples * std::max(width_px, height_px) <= kMaxNormalMapSize_px;
}

bool canInterpolate(const NormalMap& map) {
  return canInterpolate(map.width_px, map.height_px);
}

}  // namespace glintmark
