// Filters of the surface that a map makes when it is interpolated: what levels above the first see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/filter/interpolated_normals.h"
#include "host/filter/normal_moments.h"
#include "host/mixture/normal_mixture.h"
#include "tests/filter/mixture_checks.h"

namespace glintmark {
namespace {

// The unit normal at (u, v) texels from the corner of the repeating map, bilinear between centres.
glm::dvec3 surfaceNormal(const NormalMap& map, double u, double v) {
  const double x = u - 0.5, y = v - 0.5;
  const int left = static_cast<int>(std::floor(x)), low = static_cast<int>(std::floor(y));
  glm::dvec3 sum(0);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int column = (left + i + map.width_px) % map.width_px;
      const int row = (low + j + map.height_px) % map.height_px;
      sum += (1 - std::abs(x - left - i)) * (1 - std::abs(y - low - j)) *
             glm::dvec3(map.at(column, row));
    }
  return glm::normalize(sum);
}

// Means over a texel of a level of (x, y, z, x^2 + y^2), by `side` samples a side of each texel of
// the map below it; sides of the map are powers of two.
glm::dvec4 surfaceMean(const NormalMap& map, int level, int x, int y, int side) {
  const int texels = 1 << level, count = texels * side;
  glm::dvec4 sum(0);
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 n =
          surfaceNormal(map, x * texels + (i + 0.5) / side, y * texels + (j + 0.5) / side);
      sum += glm::dvec4(n, n.x * n.x + n.y * n.y);
    }
  return sum / static_cast<double>(count) / static_cast<double>(count);
}

glm::dvec4 mixtureMean(const NormalMixtures& mixtures, int level, int x, int y) {
  glm::dvec4 sum(0);
  for (int i = 0; i < mixtures.lobes; ++i) {
    const float4& m = mixtures.moments.at(level, x, y)[i];
    sum += glm::dvec4(m.y, m.z, 0, m.w);
  }
  return sum;
}

constexpr MixtureOptions kOfTheSurface{.surface = MixtureSurface::kInterpolated};

TEST(InterpolatedSurface, CoarserMixturesHaveTheMomentsOfItsSamples) {
  const NormalMap map = randomMap(16, 32);
  const NormalMixtures mixtures = fitNormalMixtures(map, kOfTheSurface);
  for (int level = 1; level < 5; ++level)
    for (int y = 0; y < mixtures.moments.levelHeight(level); ++y)
      for (int x = 0; x < mixtures.moments.levelWidth(level); ++x) {
        const glm::dvec4 want = surfaceMean(map, level, x, y, kSurfaceSamples);
        const glm::dvec4 got = mixtureMean(mixtures, level, x, y);
        ASSERT_NEAR(got.x, want.x, kMomentTolerance) << level;
        ASSERT_NEAR(got.y, want.y, kMomentTolerance) << level;
        ASSERT_NEAR(got.w, want.w, kMomentTolerance) << level;
      }
}

TEST(InterpolatedSurface, TheFinestTexelsAreTheMaps) {
  const NormalMap map = randomMap(8, 8);
  const NormalMixtures mixtures = fitNormalMixtures(map, kOfTheSurface);
  const MipTexels means = meanNormals(map), slopes = leanMoments(map);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const glm::vec3& n = map.at(x, y);
      EXPECT_NEAR(mixtureMean(mixtures, 0, x, y).x, n.x, kMomentTolerance);
      EXPECT_EQ(means.at(0, x, y)->z, n.z);
      EXPECT_NEAR(slopes.at(0, x, y)->x, n.x / n.z, kMomentTolerance);
    }
}

TEST(InterpolatedSurface, CoarserMeansAreThoseOfItsSamples) {
  const NormalMap map = randomMap(16, 16);
  const MipTexels means = meanNormals(map);
  for (int level = 1; level < 5; ++level)
    for (int x = 0; x < means.levelWidth(level); ++x) {
      const glm::dvec4 want = surfaceMean(map, level, x, 0, kSurfaceSamples);
      const float4& got = *means.at(level, x, 0);
      ASSERT_NEAR(got.x, want.x, kMomentTolerance) << level;
      ASSERT_NEAR(got.y, want.y, kMomentTolerance) << level;
      ASSERT_NEAR(got.z, want.z, kMomentTolerance) << level;
    }
}

// Two samples a side are enough: second moments over two texels a side are some ten times nearer to
// those of sixteen than the texels' own are.
TEST(InterpolatedSurface, TwoSamplesASideStandForIt) {
  const NormalMap map = generateNormalMap({.kind = "disk", .size_px = 64});
  const NormalMixtures surface = fitNormalMixtures(map, kOfTheSurface);
  const NormalMixtures texels = fitNormalMixtures(map, {.surface = MixtureSurface::kTexels});
  double of_surface = 0, of_texels = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const double want = surfaceMean(map, 1, x, y, 16).w;
      of_surface += std::abs(mixtureMean(surface, 1, x, y).w - want);
      of_texels += std::abs(mixtureMean(texels, 1, x, y).w - want);
    }
  EXPECT_GT(of_texels, 0);
  EXPECT_LT(of_surface, 0.3 * of_texels);
}

// Maps whose sides are powers of two are worked out a few rows at a time.
TEST(InterpolatedSurface, RowsAtATimeMakeTheNumbersOfTheWhole) {
  for (const auto& [width, height] : {std::pair{16, 256}, {128, 1}, {1, 4}, {12, 8}, {7, 5}}) {
    const NormalMap map = randomMap(width, height);
    const MipTexels means = meanNormals(map);
    const NormalMap fine = interpolatedNormals(map, kSurfaceSamples);
    Image image(fine.width_px, fine.height_px, 3);
    for (std::size_t i = 0; i < fine.normals.size(); ++i)
      for (int c = 0; c < 3; ++c)
        image.pixels[3 * i + static_cast<std::size_t>(c)] = fine.normals[i][c];
    const MipChain whole = makeMipChain(image);
    for (int level = 1; level < static_cast<int>(means.layout.level_count); ++level)
      for (int y = 0; y < means.levelHeight(level); ++y)
        for (int x = 0; x < means.levelWidth(level); ++x) {
          const auto wanted = whole.levels[static_cast<std::size_t>(level) + 1].at(x, y);
          const float4& got = *means.at(level, x, y);
          ASSERT_TRUE(got.x == wanted[0] && got.y == wanted[1] && got.z == wanted[2] && got.w == 0)
              << width << 'x' << height << " level " << level << ": " << x << ", " << y;
        }
  }
}

TEST(InterpolatedSurface, MapsOfMostTexelsAreFilteredAsTexels) {
  NormalMap map;
  map.width_px = kMaxNormalMapSize_px / kSurfaceSamples;
  map.height_px = 1;
  EXPECT_TRUE(canInterpolate(map));
  ++map.width_px;
  EXPECT_FALSE(canInterpolate(map));
}

}  // namespace
}  // namespace glintmark
