// Decoding of normal maps and height fields, and what they refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "host/core/error.h"
#include "host/filter/normal_map.h"
#include "host/filter/normal_map_generators.h"

namespace glintmark {
namespace {

// Eight bits put a component off by up to 1/255, and making the normal unit moves it as much again.
constexpr float kEightBitError = 2.0f / 255;
// Central differences of a sine of 64 texels per period: (2 pi / 64)^2 / 6 of the slope.
constexpr double kDifferenceError = 2e-3;

Image texelImage(int channels, std::initializer_list<float> values) {
  Image image(static_cast<int>(values.size()) / channels, 1, channels);
  image.pixels = values;
  return image;
}

std::string messageOf(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(NormalMap, ReadsEightBitColours) {
  const glm::vec3 n = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
  const auto code = [](float c) { return std::round((c * 0.5f + 0.5f) * 255) / 255; };
  const Image image = texelImage(3, {code(n.x), code(n.y), code(n.z)});
  const NormalMap down = decodeNormalMap(image, "map", {.green = GreenAxis::kDown});
  EXPECT_LT(glm::length(down.at(0, 0) - n), kEightBitError);
  const NormalMap up = decodeNormalMap(image, "map", {.green = GreenAxis::kUp});
  EXPECT_LT(glm::length(up.at(0, 0) - glm::vec3(n.x, -n.y, n.z)), kEightBitError);
}

TEST(NormalMap, ReadsSignedFloatsAndTwoChannels) {
  const NormalMap three = decodeNormalMap(texelImage(3, {-0.6f, 0, 0.8f}), "map", {});
  EXPECT_NEAR(three.at(0, 0).x, -0.6f, 1e-6f);
  const NormalMap two = decodeNormalMap(texelImage(2, {0.8f, 0.5f}), "map", {});
  EXPECT_NEAR(two.at(0, 0).x, 0.6f, 1e-6f);
  EXPECT_NEAR(two.at(0, 0).z, 0.8f, 1e-6f);
}

TEST(NormalMap, FlatStaysFlat) {
  for (const float step : {1.0f / 255, 1.0f / 65535}) {
    const float above = (0.5f + step / 2), below = 0.5f - step / 2;
    for (const float x : {above, below})
      for (const float y : {above, below}) {
        Image image = texelImage(3, {x, y, 1, 0.6f, 0.5f, 0.98f});
        image.step = step;
        EXPECT_EQ(decodeNormalMap(image, "map").at(0, 0), glm::vec3(0, 0, 1)) << x << " " << y;
        // The next step up is a slope.
        image.pixels[0] = above + step;
        EXPECT_GT(decodeNormalMap(image, "map").at(0, 0).x, step);
      }
  }
}

TEST(NormalMap, SignAndRangeAreThoseThatMakeUnitNormals) {
  // Stored as (n + 1) / 2 with one value that resampling took below 0.
  Image coded(32, 32, 3);
  for (std::size_t i = 0; i < coded.pixels.size(); i += 3) {
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, -0.2f, 1));
    for (int c = 0; c < 3; ++c) coded.pixels[i + static_cast<std::size_t>(c)] = 0.5f * n[c] + 0.5f;
  }
  const glm::vec3 wanted = decodeNormalMap(coded, "map").at(5, 5);
  EXPECT_NEAR(wanted.x, 0.3f / std::sqrt(1.13f), 1e-5f);
  coded.pixels[0] = -0.001f, coded.pixels[1] = coded.pixels[2] = 0.5f;
  EXPECT_EQ(decodeNormalMap(coded, "map").at(5, 5), wanted);
  // Stored as they are, none of them with a negative component.
  Image stored(32, 32, 3);
  for (std::size_t i = 0; i < stored.pixels.size(); i += 3)
    stored.pixels[i] = 0.36f, stored.pixels[i + 1] = 0.48f, stored.pixels[i + 2] = 0.8f;
  EXPECT_NEAR(decodeNormalMap(stored, "map", {.green = GreenAxis::kDown}).at(3, 3).y, 0.48f, 1e-6f);
  // Of eight bits they are a picture of something else.
  stored.step = 1.0f / 255;
  EXPECT_THROW(decodeNormalMap(stored, "map"), Error);
}

TEST(NormalMap, HeightsGiveTheSlopesOfASine) {
  constexpr int kSize = 64;
  constexpr double kScale = 0.1;
  Image heights(kSize, kSize, 1);
  const auto angle = [](int i) { return 2 * std::numbers::pi * (i + 0.5) / kSize; };
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) heights.at(x, y)[0] = static_cast<float>(std::sin(angle(x)));
  }
  const NormalMap map = normalsFromHeights(heights, kScale, "sine");
  for (int x = 0; x < kSize; ++x) {
    const double slope = 2 * std::numbers::pi * kScale * std::cos(angle(x));
    EXPECT_NEAR(-map.at(x, 5).x / map.at(x, 5).z, slope, kDifferenceError);
    EXPECT_EQ(map.at(x, 5).y, 0);
  }
}

TEST(NormalMap, NamesWhatIsWrong) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto decode = [](const Image& image) { decodeNormalMap(image, "brick.png", {}); };
  EXPECT_NE(messageOf([&] {
              decode(texelImage(1, {0, 0, nan}));
            }).find("texel (2, 0)"),
            std::string::npos);
  EXPECT_NE(messageOf([&] {
              decode(texelImage(3, {0.5f, 0.5f, 0.0f}));
            }).find("into the surface"),
            std::string::npos);
  EXPECT_NE(messageOf([&] {
              decode(texelImage(3, {0.5f, 0.6f, 0.6f}));
            }).find("not unit"),
            std::string::npos);
  EXPECT_NE(messageOf([&] { decode(Image()); }).find("0x0"), std::string::npos);
  Image huge;
  huge.width = kMaxNormalMapSize_px + 1, huge.height = huge.channels = 1;
  EXPECT_NE(messageOf([&] { decode(huge); }).find("16385x1"), std::string::npos);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(normalsFromHeights(texelImage(1, {0}), infinity, "x"), Error);
  EXPECT_THROW(decodeNormalMap(texelImage(1, {0}), "x", {.content = MapContent::kNormals}), Error);
}

// Waves one by one, as the sum of cosines says.
TEST(NormalMap, NoiseIsTheSumOfItsWaves) {
  constexpr int kSize = 300;  // no power of two, and no multiple of the columns made at once
  constexpr std::uint32_t kSeed = 5;
  struct Wave {
    double u, v, phase, height;
  };
  std::vector<Wave> waves;
  const auto add = [&](std::uint32_t seed, int count, double lowest, double highest, double scale) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return random() * 0x1p-32; };
    for (int i = 0; i < count; ++i) {
      const double cycles = lowest + (highest - lowest) * uniform();
      const double angle = 2 * std::numbers::pi * uniform();
      const double u = std::round(cycles * std::cos(angle)),
                   v = std::round(cycles * std::sin(angle));
      waves.push_back({u, v, 2 * std::numbers::pi * uniform(), scale * std::sqrt(2.0 / count)});
    }
  };
  add(kSeed, 32, 10, 25, 1.2e-3);
  add(kSeed + 1, 48, 50, 110, 4e-4);
  const Image heights = generateHeights({.kind = "bumps", .size_px = kSize, .seed = kSeed});
  for (const auto& [x, y] : {std::pair{0, 0}, {255, 15}, {256, 16}, {299, 299}, {17, 288}}) {
    double sum = 0;
    for (const Wave& wave : waves)
      sum += wave.height *
             std::cos(2 * std::numbers::pi * (wave.u * (x + 0.5) + wave.v * (y + 0.5)) / kSize +
                      wave.phase);
    EXPECT_NEAR(heights.at(x, y)[0], sum, 1e-9) << x << ' ' << y;
  }
}

TEST(NormalMap, GeneratorsMakeValidMapsThatRepeat) {
  for (const std::string& kind : normalMapGenerators()) {
    const NormalMapRecipe recipe{.kind = kind, .size_px = 96};
    const NormalMap map = generateNormalMap(recipe);
    EXPECT_NO_THROW(checkNormalMap(map)) << kind;
    EXPECT_EQ(map.normals, generateNormalMap(recipe).normals) << kind;
    // A field that did not repeat would be torn at the seam: the steepest step there is far above
    // those inside.
    const Image heights = generateHeights(recipe);
    float inside = 0, seam = 0;
    for (int y = 0; y < 96; ++y) {
      for (int x = 1; x < 96; ++x) {
        inside = std::max(inside, std::abs(heights.at(x, y)[0] - heights.at(x - 1, y)[0]));
        inside = std::max(inside, std::abs(heights.at(y, x)[0] - heights.at(y, x - 1)[0]));
      }
      seam = std::max(seam, std::abs(heights.at(0, y)[0] - heights.at(95, y)[0]));
      seam = std::max(seam, std::abs(heights.at(y, 0)[0] - heights.at(y, 95)[0]));
    }
    EXPECT_LE(seam, 1.2f * inside) << kind;
  }
  EXPECT_NE(messageOf([] { generateNormalMap({.kind = "lawn"}); }).find("dunes"),
            std::string::npos);
  EXPECT_THROW(generateNormalMap({.size_px = 0}), Error);
}

}  // namespace
}  // namespace glintmark
