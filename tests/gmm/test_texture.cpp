// The texture fetch against the double-precision reference: footprints, levels, borders, widths.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "tests/glint/pixel_harness.h"
#include "tests/gmm/texture_harness.h"

namespace glintmark {
namespace {

/// Positions are good to 2^-16 texels and levels to some 1e-6; neighbouring random texels differ by
/// up to 2, and a probe adds eight of them.
constexpr double kFetchTolerance = 3e-4;
/// Single precision of axes and logarithm.
constexpr double kLevelTolerance = 1e-5;
/// Around whole ratios rounding decides the number of probes.
constexpr double kRatioMargin = 1e-4;

constexpr int kMostProbes = 16;

double uvOf(std::uint32_t fraction) {
  return fraction * 0x1p-32;
}

// Footprints of all sizes, shapes and directions.
std::vector<TexturePixel> randomPixels(std::size_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<TexturePixel> pixels(n);
  for (TexturePixel& p : pixels) {
    p.u = static_cast<std::uint32_t>(random());
    p.v = static_cast<std::uint32_t>(random());
    const float length = std::exp2(-12 + 13 * unit(random)),
                slimness = std::exp2(-6 * unit(random));
    const float a = 6.2831853f * unit(random), b = 6.2831853f * unit(random);
    // A rotation, a stretch, a rotation.
    const float c = std::cos(a), s = std::sin(a), x = std::cos(b), y = std::sin(b);
    p.dudx = length * (c * x - slimness * s * y);
    p.dvdx = length * (s * x + slimness * c * y);
    p.dudy = length * (-c * y - slimness * s * x);
    p.dvdy = length * (-s * y + slimness * c * x);
  }
  return pixels;
}

reference::ProbeLine referenceLine(const TestTexture& texture, const TexturePixel& p,
                                   int most_probes) {
  return reference::footprintProbes(
      static_cast<int>(texture.header.width), static_cast<int>(texture.header.height),
      static_cast<int>(texture.header.level_count), {uvOf(p.u), uvOf(p.v)},
      {{p.dudx, p.dvdx}, {p.dudy, p.dvdy}}, most_probes);
}

bool nearWhole(double ratio) {
  const double x = ratio - 0.01;
  return std::abs(x - std::round(x)) < kRatioMargin;
}

struct Shape {
  int width, height, texel_size;
};

class TextureShapes : public testing::TestWithParam<Shape> {};

TEST_P(TextureShapes, MatchTheReference) {
  const auto [width, height, texel_size] = GetParam();
  const TestTexture texture = randomTexture(width, height, texel_size, 7);
  const std::vector<TexturePixel> pixels = randomPixels(400, 11);
  const auto fetched = fetchPixels(texture, texel_size, pixels, kMostProbes, true, 16);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const reference::ProbeLine line = referenceLine(texture, pixels[i], kMostProbes);
    EXPECT_NEAR(fetched[i].level, line.level, kLevelTolerance) << "pixel " << i;
    if (nearWhole(line.ratio)) continue;
    ++compared;
    ASSERT_EQ(fetched[i].count, line.count) << "pixel " << i;
    const std::vector<double> expected = reference::filterTexture(texture.levels, line, true);
    for (std::size_t c = 0; c < expected.size(); ++c)
      ASSERT_NEAR(fetched[i].values[c], expected[c], kFetchTolerance)
          << "pixel " << i << ", component " << c;
  }
  EXPECT_GT(compared, pixels.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Sizes, TextureShapes,
                         testing::Values(Shape{64, 64, 1}, Shape{64, 64, 4}, Shape{37, 19, 1},
                                         Shape{1, 1, 1}, Shape{1, 53, 2}, Shape{96, 1, 1},
                                         Shape{33, 65, 8}, Shape{20, 30, 3}, Shape{20, 30, 6}));

TEST(Texture, EveryWidthGivesTheSameBits) {
  const TestTexture texture = randomTexture(48, 31, 4, 3);
  const std::vector<TexturePixel> pixels = randomPixels(333, 5);
  const auto narrow = fetchPixels(texture, 4, pixels, kMostProbes, true, 1);
  for (const int width : {4, 8, 16}) {
    const auto wide = fetchPixels(texture, 4, pixels, kMostProbes, true, width);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      for (std::size_t c = 0; c < 16; ++c)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(narrow[i].values[c]),
                  std::bit_cast<std::uint32_t>(wide[i].values[c]))
            << "pixel " << i << " at width " << width;
  }
}

TEST(Texture, ClampedBordersGoOn) {
  const TestTexture texture = randomTexture(16, 16, 1, 3);
  std::vector<TexturePixel> pixels(2);
  pixels[1].u = pixels[1].v = 0xFFFFFFFFu;
  const auto fetched = fetchPixels(texture, 1, pixels, 1, false, 16);
  EXPECT_FLOAT_EQ(fetched[0].values[0], texture.texels[0].x);
  EXPECT_NEAR(fetched[1].values[0], texture.texels[255].x, kFetchTolerance);
}

TEST(Texture, BadDerivativesReadFiniteValues) {
  const TestTexture texture = randomTexture(16, 16, 1, 3);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  std::vector<TexturePixel> pixels;
  for (const float bad : {nan, infinite, -infinite, 0.0f, 1e-38f, 1e30f, -1e30f})
    for (const float other : {0.0f, 1e-3f, bad})
      pixels.push_back({1u << 30, 1u << 29, bad, other, other, bad});
  for (const FetchedTexel& texel : fetchPixels(texture, 1, pixels, kMostProbes, true, 16)) {
    EXPECT_TRUE(std::isfinite(texel.values[0]) && std::abs(texel.values[0]) <= 1);
    EXPECT_GE(texel.count, 1);
    EXPECT_LE(texel.count, kMostProbes);
  }
}

TEST(Texture, IsotropicProbesAreAtLeastAsWideAsTheMajorAxis) {
  const TestTexture texture = randomTexture(64, 64, 1, 3);
  const auto fetched = fetchPixels(texture, 1, {{0, 0, 0.25f, 0, 0, 0.015625f}}, 1, true, 16);
  EXPECT_EQ(fetched[0].count, 1);
  EXPECT_NEAR(fetched[0].level, std::log2(16 / std::sqrt(3.0)), kLevelTolerance);
}

}  // namespace
}  // namespace glintmark
