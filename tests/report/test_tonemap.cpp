#include "host/report/picture/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/core/error.h"

namespace glintmark {
namespace {

Image grey(std::vector<float> values) {
  Image image(static_cast<int>(values.size()), 1, 1);
  image.pixels = std::move(values);
  return image;
}

TEST(ToneMap, SrgbFixedPoints) {
  EXPECT_FLOAT_EQ(encodeSrgb(0), 0);
  EXPECT_NEAR(encodeSrgb(1), 1, 1e-6);
  EXPECT_NEAR(encodeSrgb(0.2140411f), 0.5, 1e-5);  // from IEC 61966-2-1's inverse at one half
  EXPECT_NEAR(encodeSrgb(0.001f), 0.01292, 1e-7);  // linear part
}

TEST(ToneMap, CurveByHand) {
  // x = 2 * 0.5 = 1, white 2: 1 * (1 + 1/4) / 2 = 0.625.
  const Image display = toneMap(grey({0.5f}), {.exposure = 2, .white = 2});
  EXPECT_EQ(display.channels, 3);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(display.pixels[c], encodeSrgb(0.625f), 1e-6);
}

TEST(ToneMap, WhitePointReachesWhite) {
  const Image display = toneMap(grey({4, 3.999f, 1e30f}), {.exposure = 1, .white = 4});
  EXPECT_EQ(display.at(0, 0)[0], 1);
  EXPECT_NEAR(display.at(1, 0)[0], 1, 1e-3);
  EXPECT_EQ(display.at(2, 0)[0], 1);
}

TEST(ToneMap, BadValuesStayInRange) {
  const float infinity = std::numeric_limits<float>::infinity();
  const Image display = toneMap(grey({-1, std::nanf(""), infinity, -infinity}), {});
  EXPECT_EQ(display.at(0, 0)[0], 0);
  EXPECT_EQ(display.at(1, 0)[0], 0);
  EXPECT_EQ(display.at(2, 0)[0], 1);
  EXPECT_EQ(display.at(3, 0)[0], 0);
}

TEST(ToneMap, MonotonicAndColoursKeepTheirOrder) {
  float last = -1;
  for (float x = 0; x < 10; x += 0.1f) {
    const float y = toneMap(grey({x}), {}).pixels[0];
    EXPECT_GE(y, last);
    last = y;
  }
  Image rgba(1, 1, 4);
  rgba.pixels = {3, 2, 1, 1};
  const Image display = toneMap(rgba, {});
  EXPECT_GT(display.pixels[0], display.pixels[1]);
  EXPECT_GT(display.pixels[1], display.pixels[2]);
}

TEST(ToneMap, TwoChannelsAreAnError) {
  EXPECT_THROW(toneMap(Image(1, 1, 2), {}), Error);
}

}  // namespace
}  // namespace glintmark
