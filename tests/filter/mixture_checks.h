// Maps to fit mixtures to, and the moments that every mixture must have.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "host/filter/mip_chain.h"
#include "host/filter/normal_map_generators.h"
#include "host/mixture/normal_mixture.h"

namespace glintmark {

// Moments of magnitude up to 1, summed in single precision over a vector's lanes.
inline constexpr double kMomentTolerance = 3e-6;

inline NormalMap mapOf(int width, int height, const auto& normal) {
  NormalMap map{"test", width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map.normals.push_back(glm::normalize(normal(x, y)));
  }
  return map;
}

inline NormalMap randomMap(int width, int height) {
  std::mt19937 random(3);
  const auto uniform = [&] { return static_cast<float>(random() * 0x1p-31 - 1); };
  return mapOf(width, height, [&](int, int) { return glm::vec3(uniform(), uniform(), 0.5f); });
}

// No variance, equal normals, opposite slopes near the horizon, steep creases, a strip.
inline std::vector<NormalMap> hardMaps() {
  const auto steep = [](int x, int y) {
    return glm::vec3((x & 1) ? 1 : -1, (y & 1) ? 0.3f : -0.3f, 1e-3f);
  };
  return {generateNormalMap({.kind = "flat", .size_px = 32}),
          mapOf(32, 32, [](int, int) { return glm::vec3(0.6f, -0.3f, 0.5f); }),
          mapOf(32, 32, steep),
          generateNormalMap({.kind = "armour", .size_px = 64, .height_scale = 100}),
          mapOf(3, 200, steep)};
}

// Chain of the true moments (1, x, y, x^2 + y^2).
inline MipChain trueMoments(const NormalMap& map) {
  Image finest(map.width_px, map.height_px, 4);
  for (std::size_t i = 0; i < map.normals.size(); ++i) {
    const glm::vec3& n = map.normals[i];
    const float values[] = {1, n.x, n.y, n.x * n.x + n.y * n.y};
    std::ranges::copy(values, finest.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return makeMipChain(std::move(finest));
}

inline void expectExactMoments(const NormalMap& map, const NormalMixtures& mixtures) {
  const MipChain expected = trueMoments(map);
  for (std::size_t level = 0; level < expected.levels.size(); ++level) {
    const Image& image = expected.levels[level];
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        double sums[4] = {};
        for (int i = 0; i < mixtures.lobes; ++i) {
          const float4& m = mixtures.moments.at(static_cast<int>(level), x, y)[i];
          sums[0] += m.x, sums[1] += m.y, sums[2] += m.z, sums[3] += m.w;
          ASSERT_TRUE(std::isfinite(m.x + m.y + m.z + m.w));
          ASSERT_GE(m.x, 0);
          const double spread = m.w * m.x - (m.y * m.y + m.z * m.z);
          ASSERT_GE(spread, -kMomentTolerance * m.x) << "variance below 0";
        }
        for (int c = 0; c < 4; ++c) {
          ASSERT_NEAR(sums[c], image.at(x, y)[c], kMomentTolerance)
              << map.name << " level " << level << " texel " << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace glintmark
