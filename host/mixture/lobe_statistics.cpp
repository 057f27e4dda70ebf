#include "host/mixture/lobe_statistics.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/mixture/mixture_fit_types.h"
#include "host/mixture/mixture_level.h"

namespace glintmark {
namespace {

// Sums over a lobe's share of the normals under a texel, over the weight of all of them.
struct LobeSums {
  double a = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0;
};
using TexelSums = std::array<LobeSums, kMaxLobes>;

// log of weight times density, and the parts of it that do not depend on the normal.
struct LogLobe {
  double mean_x, mean_y, minus_half_precision, constant;
};

std::vector<LogLobe> logLobes(const NormalMixtures& mixtures, int level, glm::ivec2 texel) {
  std::vector<LogLobe> lobes;
  for (int i = 0; i < mixtures.lobes; ++i) {
    const NormalLobe lobe = mixtures.lobe(level, texel.x, texel.y, i);
    const double variance = std::max(lobe.variance, MF_MIN_VARIANCE);
    lobes.push_back({lobe.mean.x, lobe.mean.y, -0.5 / variance,
                     lobe.weight > 0 ? std::log(lobe.weight / variance) : -1e300});
  }
  return lobes;
}

void addNormal(const std::vector<LogLobe>& lobes, double x, double y, double weight,
               TexelSums& sums) {
  std::array<double, kMaxLobes> share{};
  double most = -1e300, total = 0;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    const double dx = x - lobes[i].mean_x, dy = y - lobes[i].mean_y;
    share[i] = lobes[i].constant + lobes[i].minus_half_precision * (dx * dx + dy * dy);
    most = std::max(most, share[i]);
  }
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    share[i] = std::exp(share[i] - most);
    total += share[i];
  }
  const double z = std::sqrt(std::max(1 - x * x - y * y, 0.0));
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    const double r = weight * share[i] / total;
    LobeSums& s = sums[i];
    s.a += r, s.x += r * x, s.y += r * y, s.z += r * z;
    s.xx += r * x * x, s.xy += r * x * y, s.yy += r * y * y;
  }
}

// Calls store(level, texel, sums) for every texel.
template <typename Store>
void forEachTexel(const NormalMap& map, const NormalMixtures& mixtures, MixtureSurface surface,
                  const Store& store) {
  const FittedNormals normals(map, surface);
  for (int level = 0; level < static_cast<int>(mixtures.moments.layout.level_count); ++level) {
    const MixtureLevel geometry = normals.level(level);
    tbb::parallel_for(0, geometry.height(), [&](int y) {
      for (int x = 0; x < geometry.width(); ++x) {
        const std::vector<LogLobe> lobes = logLobes(mixtures, level, {x, y});
        TexelSums sums{};
        double weights = 0;
        for (const NormalRow& row : geometry.rows({x, y}))
          for (std::size_t i = 0; i < row.count; ++i) {
            const double weight = static_cast<double>(row.row_weight) * row.weight[i];
            addNormal(lobes, row.x[i], row.y[i], weight, sums);
            weights += weight;
          }
        for (LobeSums& s : sums)
          for (double* sum : {&s.a, &s.x, &s.y, &s.z, &s.xx, &s.xy, &s.yy}) *sum /= weights;
        store(level, glm::ivec2(x, y), sums);
      }
    });
  }
}

float4 floatsOf(double x, double y, double z, double w) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
          static_cast<float>(w)};
}

}  // namespace

MipTexels sphereLobes(const NormalMap& map, const NormalMixtures& mixtures,
                      MixtureSurface surface) {
  MipTexels texels = makeMipTexels(map.width_px, map.height_px, mixtures.lobes);
  forEachTexel(map, mixtures, surface, [&](int level, glm::ivec2 texel, const TexelSums& sums) {
    float4* to = texels.at(level, texel.x, texel.y);
    for (int i = 0; i < mixtures.lobes; ++i) {
      const LobeSums& s = sums[static_cast<std::size_t>(i)];
      to[i] = floatsOf(s.x, s.y, s.z, s.a);
    }
  });
  return texels;
}

MipTexels covarianceLobes(const NormalMap& map, const NormalMixtures& mixtures,
                          MixtureSurface surface) {
  const int lobes = mixtures.lobes;
  MipTexels texels = makeMipTexels(map.width_px, map.height_px, covarianceVectors(lobes));
  forEachTexel(map, mixtures, surface, [&](int level, glm::ivec2 texel, const TexelSums& sums) {
    float4* to = texels.at(level, texel.x, texel.y);
    for (int i = 0; i < lobes; ++i) {
      const LobeSums& s = sums[static_cast<std::size_t>(i)];
      to[i] = floatsOf(s.a, s.x, s.y, s.xx);
      float4& pair = to[lobes + i / 2];
      if (i % 2 == 0)
        pair = floatsOf(s.yy, s.xy, 0, 0);
      else
        pair = {pair.x, pair.y, static_cast<float>(s.yy), static_cast<float>(s.xy)};
    }
  });
  return texels;
}

}  // namespace glintmark
