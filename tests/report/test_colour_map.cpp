#include "host/report/picture/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace glintmark {
namespace {

float decodeSrgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

// CIE lightness of a display colour, 0 to 100: an oracle other than the OKLab the map is made with.
double cieLightness(const DisplayColour& colour) {
  const double y = 0.2126 * decodeSrgb(colour[0]) + 0.7152 * decodeSrgb(colour[1]) +
                   0.0722 * decodeSrgb(colour[2]);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

TEST(ColourMap, LightnessRisesEvenly) {
  double last = cieLightness(falseColour(0));
  EXPECT_LT(last, 20);
  constexpr int kSteps = 16;
  for (int i = 1; i <= kSteps; ++i) {
    const double lightness = cieLightness(falseColour(static_cast<double>(i) / kSteps));
    EXPECT_GT(lightness - last, 2) << i;  // 80 over 16 steps is 5 each; OKLab and CIE differ a bit
    EXPECT_LT(lightness - last, 9) << i;
    last = lightness;
  }
  EXPECT_GT(last, 85);
}

TEST(ColourMap, EndsAreVioletAndYellow) {
  const DisplayColour low = falseColour(0), high = falseColour(1);
  EXPECT_GT(low[2], low[1]);
  EXPECT_GT(low[0], low[1]);
  EXPECT_GT(high[0], high[2]);
  EXPECT_GT(high[1], high[2]);
}

TEST(ColourMap, OutsideIsClamped) {
  EXPECT_EQ(falseColour(-5), falseColour(0));
  EXPECT_EQ(falseColour(5), falseColour(1));
  EXPECT_EQ(falseColour(std::nan("")), falseColour(0));
  for (double t = 0; t <= 1; t += 0.01) {
    for (const float c : falseColour(t)) {
      EXPECT_GE(c, 0);
      EXPECT_LE(c, 1);
    }
  }
}

}  // namespace
}  // namespace glintmark
