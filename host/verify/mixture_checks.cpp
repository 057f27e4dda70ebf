// Mixtures of normals fitted on the device: moments against sums over the normals, a chain of steps
// against the host's own fit, and clusters that are known.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/filter/normal_map_generators.h"
#include "host/mixture/device_mixture_fit.h"
#include "host/verify/check_groups.h"
#include "host/verify/mixture_step_check.h"

namespace glintmark {
namespace {

NormalMap noisyMap(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, 0.3f);
  NormalMap map;
  map.name = "noise";
  map.width_px = width;
  map.height_px = height;
  for (int i = 0; i < width * height; ++i) {
    const float x = normal(random), y = normal(random);  // in this order
    map.normals.push_back(glm::normalize(glm::vec3(x, y, 1)));
  }
  return map;
}

NormalMixtures fit(const CheckContext& context, const NormalMap& map,
                   const MixtureOptions& options = {}) {
  return fitMixturesOnDevice(context.bench.device, context.bench.cache, context.lanes, map,
                             options);
}

// Share of fine texel i that lies under coarse texel x, times the number of coarse ones over that
// of fine ones: shares of one coarse texel add up to 1.
double covered(int i, int fine, int x, int coarse) {
  const double low = std::max(static_cast<double>(i) / fine, static_cast<double>(x) / coarse);
  const double high =
      std::min(static_cast<double>(i + 1) / fine, static_cast<double>(x + 1) / coarse);
  return std::max(high - low, 0.0) * coarse;
}

// Weight, mean and mean square of the normals under a texel, whatever the lobes are.
Finding momentsOfNormals(const CheckContext& context) {
  Finding finding(2e-5);  // sums of up to some thousand floats
  for (const auto& [width, height] : {std::pair{32, 32}, {37, 23}, {1, 50}, {70, 1}, {130, 40}}) {
    const NormalMap map = noisyMap(width, height, 5);
    const NormalMixtures fitted = fit(context, map);
    for (int level = 1; level < static_cast<int>(fitted.levels.size()); ++level) {
      const int columns = fitted.moments.levelWidth(level),
                rows = fitted.moments.levelHeight(level);
      const int step = std::max(columns * rows / 40, 1);
      for (int texel = 0; texel < columns * rows; texel += step) {
        const int x = texel % columns, y = texel / columns;
        glm::dvec4 want(0), got(0);
        for (int j = 0; j < height; ++j)
          for (int i = 0; i < width; ++i) {
            const glm::dvec3 n(map.at(i, j));
            want += covered(i, width, x, columns) * covered(j, height, y, rows) *
                    glm::dvec4(1, n.x, n.y, n.x * n.x + n.y * n.y);
          }
        for (int k = 0; k < fitted.lobes; ++k) {
          const float4& m = fitted.moments.at(level, x, y)[k];
          got += glm::dvec4(m.x, m.y, m.z, m.w);
        }
        for (int c = 0; c < 4; ++c) finding.add(std::abs(got[c] - want[c]));
      }
    }
  }
  return finding;
}

// After one step of each texel the device and the host have the same mixtures at every level:
// rounding of exp2, log2 and sums is carried from level to level, 5e-5 of moments up to 1. What a
// step is, mixture/one_step says.
Finding hostsSteps(const CheckContext& context) {
  Finding finding(2e-4);
  const NormalMap maps[] = {generateNormalMap({.kind = "disk", .size_px = 64}), noisyMap(37, 23, 6),
                            noisyMap(70, 3, 7)};
  for (const NormalMap& map : maps)
    for (const int passes : {1, 2}) {
      const MixtureOptions options{.passes = passes, .max_iterations = 1, .tolerance = 1e-30f};
      const NormalMixtures device = fit(context, map, options),
                           host = fitNormalMixtures(map, options);
      for (std::size_t i = 0; i < device.moments.texels.size(); ++i) {
        const float4 &a = device.moments.texels[i], &b = host.moments.texels[i];
        for (const float d : {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}) finding.add(std::abs(d));
      }
    }
  return finding;
}

// Four clusters far apart, in known shares, means and variances: the coarsest texel finds them.
Finding clusters(const CheckContext& context) {
  constexpr int kSide = 64;
  const glm::dvec2 means[] = {{0.4, 0.4}, {-0.4, 0.3}, {0.35, -0.4}, {-0.3, -0.35}};
  const double deviations[] = {0.02, 0.05, 0.03, 0.04}, ends[] = {0.1, 0.3, 0.6, 1};
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  NormalMap map;
  map.name = "clusters";
  map.width_px = map.height_px = kSide;
  glm::dvec4 sums[4] = {};  // of each cluster: number, x, y, squares
  for (int i = 0; i < kSide * kSide; ++i) {
    const double u = static_cast<double>(random()) * 0x1p-32;
    const std::size_t k = static_cast<std::size_t>(std::ranges::upper_bound(ends, u) - ends);
    const double dx = deviations[k] * normal(random), dy = deviations[k] * normal(random);
    const glm::dvec2 m = means[k] + glm::dvec2(dx, dy);
    map.normals.push_back(glm::vec3(m.x, m.y, std::sqrt(1 - glm::dot(m, m))));
    sums[k] += glm::dvec4(1, m.x, m.y, glm::dot(m, m)) / static_cast<double>(kSide * kSide);
  }
  const NormalMixtures fitted = fit(context, map);
  const int coarsest = static_cast<int>(fitted.levels.size()) - 1;
  Finding finding(1e-3);  // eight deviations apart: what clusters share is rounding
  for (const glm::dvec4& want : sums) {
    double nearest = 1;
    for (int k = 0; k < fitted.lobes; ++k) {
      const NormalLobe lobe = fitted.lobe(coarsest, 0, 0, k);
      const glm::dvec2 mean = glm::dvec2(want.y, want.z) / want.x;
      const double variance = 0.5 * (want.w / want.x - glm::dot(mean, mean));
      nearest = std::min(nearest, std::abs(lobe.weight - want.x) +
                                      glm::length(glm::dvec2(lobe.mean) - mean) +
                                      std::abs(lobe.variance - variance));
    }
    finding.add(nearest);
  }
  return finding;
}

}  // namespace

std::vector<Check> mixtureChecks() {
  return {{"mixture/moments", "error of moments", momentsOfNormals},
          {"mixture/one_step", "weight, mean or variance off", oneStepFromGivenLobes},
          {"mixture/hosts_steps", "difference from the host's moments", hostsSteps},
          {"mixture/clusters", "weight, mean and variance off", clusters}};
}

}  // namespace glintmark
