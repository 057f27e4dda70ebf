// The fit of mixtures on the device: against the host's, at every width, moments, hard cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host/core/error.h"
#include "host/filter/normal_map_generators.h"
#include "host/harness/pixel_harness.h"
#include "host/mixture/device_mixture_fit.h"
#include "host/mixture/mixture_error.h"
#include "tests/filter/mixture_checks.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

// No texel rests: host and device then take the same steps.
constexpr float kNeverResting = 1e-30f;
// One EM step carries the rounding of exp2, log2 and sums in single precision from level to level;
// measured: 5e-5, of moments up to 1. In many steps single normals between two lobes go to one or
// the other, so there only the mean tells; measured: 3e-6.
constexpr double kOneStepTolerance = 2e-4, kMeanTolerance = 1e-5;
// Blocks of the host's texels step on until all rest, so their errors differ a little.
constexpr double kErrorTolerance = 0.02;

NormalMixtures fitAt(int lanes, const NormalMap& map, const MixtureOptions& options = {}) {
  KernelBench& bench = testBench();
  return fitMixturesOnDevice(bench.device, bench.cache, lanes, map, options);
}

bool sameBits(const NormalMixtures& a, const NormalMixtures& b) {
  const LargeArray<float4>&x = a.moments.texels, &y = b.moments.texels;
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float4)) == 0;
}

struct Difference {
  double most = 0, mean = 0;  // of moments
};

Difference difference(const NormalMixtures& a, const NormalMixtures& b) {
  Difference result;
  for (std::size_t i = 0; i < a.moments.texels.size(); ++i) {
    const float4 &x = a.moments.texels[i], &y = b.moments.texels[i];
    for (const float d : {x.x - y.x, x.y - y.y, x.z - y.z, x.w - y.w}) {
      result.most = std::max(result.most, static_cast<double>(std::abs(d)));
      result.mean += std::abs(d) / (4.0 * static_cast<double>(a.moments.texels.size()));
    }
  }
  return result;
}

TEST(DeviceMixtureFit, OneStepOfEachTexelIsTheHosts) {
  const NormalMap maps[] = {generateNormalMap({.kind = "disk", .size_px = 64}), randomMap(37, 23),
                            randomMap(1, 50), randomMap(70, 1)};
  for (const NormalMap& map : maps) {
    const MixtureOptions options{.max_iterations = 1, .tolerance = kNeverResting};
    EXPECT_LT(difference(fitAt(16, map, options), fitNormalMixtures(map, options)).most,
              kOneStepTolerance)
        << map.name << " " << map.width_px << "x" << map.height_px;
  }
}

// Four times as many normals, of which some lie between two lobes.
TEST(DeviceMixtureFit, OneStepOverTheInterpolatedSurfaceIsTheHosts) {
  for (const NormalMap& map : {generateNormalMap({.kind = "disk", .size_px = 64}),
                               randomMap(37, 23), randomMap(1, 50), randomMap(70, 1)}) {
    const MixtureOptions options{
        .surface = MixtureSurface::kInterpolated, .max_iterations = 1, .tolerance = kNeverResting};
    EXPECT_LT(difference(fitAt(16, map, options), fitNormalMixtures(map, options)).mean,
              kMeanTolerance)
        << map.name << " " << map.width_px << "x" << map.height_px;
  }
}

TEST(DeviceMixtureFit, SameMixturesAsTheHost) {
  for (const char* kind : {"disk", "dunes"}) {
    const NormalMap map = generateNormalMap({.kind = kind, .size_px = 64});
    for (const int passes : {1, 2}) {
      for (const int sweeps : {1, 2}) {
        const MixtureOptions options{
            .passes = passes, .sweeps = sweeps, .tolerance = kNeverResting};
        EXPECT_LT(difference(fitAt(16, map, options), fitNormalMixtures(map, options)).mean,
                  kMeanTolerance)
            << kind << ", " << passes << " passes, " << sweeps << " sweeps";
      }
    }
  }
}

TEST(DeviceMixtureFit, ErrorsAreThoseOfTheHost) {
  for (const char* kind : {"disk", "dunes", "armour"}) {
    const NormalMap map = generateNormalMap({.kind = kind, .size_px = 64});
    const NormalMixtures device = fitAt(16, map), host = fitNormalMixtures(map);
    for (const int level : {1, 2, 3}) {
      const InterpolationError a = measureInterpolation(map, device, level, 60, 0.07, 1);
      const InterpolationError b = measureInterpolation(map, host, level, 60, 0.07, 1);
      EXPECT_NEAR(a.fitted, b.fitted, kErrorTolerance * b.fitted + 1e-6) << kind << " " << level;
      EXPECT_NEAR(a.interpolated, b.interpolated, kErrorTolerance * b.interpolated + 1e-6)
          << kind << " " << level;
      EXPECT_NEAR(device.levels[level].log_likelihood, host.levels[level].log_likelihood, 0.02);
    }
  }
}

TEST(DeviceMixtureFit, SameBitsAtEveryWidthAndInEveryRun) {
  for (const auto& [width, height] : {std::pair{64, 64}, {37, 23}, {50, 3}, {1, 40}}) {
    const NormalMap map = randomMap(width, height);
    const NormalMixtures first = fitAt(16, map, {.passes = 2});
    for (const int lanes : {16, 4, 1}) {
      const NormalMixtures other = fitAt(lanes, map, {.passes = 2});
      EXPECT_TRUE(sameBits(first, other)) << width << "x" << height << ", " << lanes << " lanes";
      for (std::size_t level = 0; level < first.levels.size(); ++level) {
        EXPECT_EQ(first.levels[level].mean_iterations, other.levels[level].mean_iterations);
        EXPECT_EQ(first.levels[level].converged_share, other.levels[level].converged_share);
        EXPECT_EQ(first.levels[level].log_likelihood, other.levels[level].log_likelihood);
      }
    }
  }
}

TEST(DeviceMixtureFit, MomentsAreThoseOfTheNormalsAtEveryLevel) {
  for (const auto& [width, height] : {std::pair{64, 64}, {37, 23}, {1, 50}, {70, 1}, {1, 1}}) {
    expectExactMoments(randomMap(width, height), fitAt(16, randomMap(width, height)));
  }
  // One lane: the quickest to compile, and every width has the same bits.
  for (const int lobes : {1, 2, 3, kMaxLobes}) {
    const NormalMap map = randomMap(40, 33);
    expectExactMoments(map, fitAt(1, map, {.lobes = lobes}));
  }
}

TEST(DeviceMixtureFit, HardMapsStayFinite) {
  for (const NormalMap& map : hardMaps()) {
    expectExactMoments(map, fitAt(16, map));
    expectExactMoments(map, fitAt(1, map, {.lobes = 8, .sweeps = 2}));
  }
}

TEST(DeviceMixtureFit, RefusesWhatItCannotFit) {
  const NormalMap map = generateNormalMap({.kind = "flat", .size_px = 4});
  EXPECT_THROW(fitAt(16, map, {.lobes = 9}), Error);
  EXPECT_THROW(fitAt(16, map, {.order = MixtureOrder::kScanline}), Error);
  EXPECT_THROW(fitAt(16, NormalMap{}), Error);
}

}  // namespace
}  // namespace glintmark
