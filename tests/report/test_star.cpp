#include "host/report/picture/star.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace glintmark {
namespace {

// Sums of thousands of floats of mixed size; each addition rounds to 6e-8.
constexpr double kRelativeSumTolerance = 1e-5;

double sumOf(const Image& image, int channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += image.channels)
    sum += image.pixels[i];
  return sum;
}

Image dark(int width, int height) {
  Image image(width, height, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = i % 4 == 3 ? 1 : 0.1f;
  return image;
}

void setPixel(Image& image, int x, int y, float r, float g, float b) {
  const auto pixel = image.at(x, y);
  pixel[0] = r, pixel[1] = g, pixel[2] = b;
}

TEST(Star, NothingBrightNothingChanged) {
  Image image = dark(20, 20);
  const Image before = image;
  applyStar(image, {});
  EXPECT_EQ(image.pixels, before.pixels);
}

TEST(Star, KeepsTheEnergyOfEveryChannel) {
  Image image = dark(200, 100);
  setPixel(image, 100, 50, 50, 20, 10);
  setPixel(image, 0, 0, 5, 5, 500);      // most rays leave the image
  setPixel(image, 199, 60, 0, 90, 0);    // at the edge
  setPixel(image, 101, 50, 1000, 0, 0);  // beside another
  const Image before = image;
  applyStar(image, {.length = 0.2});
  EXPECT_NE(image.pixels, before.pixels);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sumOf(image, c) / sumOf(before, c), 1, kRelativeSumTolerance) << c;
  }
  EXPECT_EQ(sumOf(image, 3), sumOf(before, 3));  // alpha stays
  for (const float value : image.pixels) EXPECT_GE(value, 0);
}

TEST(Star, RaysPointWhereTheyShould) {
  Image image(101, 101, 3);
  setPixel(image, 50, 50, 100, 100, 100);
  applyStar(image, {.rays = 4, .first_ray_deg = 90, .length = 0.3});
  EXPECT_GT(image.at(50, 40)[0], 0);
  EXPECT_GT(image.at(60, 50)[0], 0);
  EXPECT_GT(image.at(50, 60)[0], 0);
  EXPECT_GT(image.at(40, 50)[0], 0);
  EXPECT_EQ(image.at(57, 57)[0], 0);                            // between the rays
  EXPECT_EQ(image.at(50, 10)[0], 0);                            // beyond their tips
  EXPECT_GT(image.at(50, 45)[0], image.at(50, 30)[0]);          // they fade
  EXPECT_NEAR(image.at(40, 50)[0], image.at(60, 50)[0], 1e-4);  // evenly
}

TEST(Star, MovesTheShareThatTheOptionsSay) {
  Image image(101, 101, 3);
  setPixel(image, 50, 50, 11, 11, 11);
  // Excess over the threshold 1 is 10; half of it moves. Upright rays leave the centre at once.
  applyStar(image, {.threshold = 1, .fraction = 0.5, .rays = 4});
  EXPECT_NEAR(image.at(50, 50)[0], 11 - 5, 0.01);
}

TEST(Star, NonFinitePixelsSpreadNothing) {
  Image image(21, 21, 3);
  setPixel(image, 10, 10, std::numeric_limits<float>::infinity(), 1, 1);
  setPixel(image, 5, 5, std::nanf(""), 1, 1);
  applyStar(image, {});
  int not_finite = 0;
  for (const float value : image.pixels) not_finite += std::isfinite(value) ? 0 : 1;
  EXPECT_EQ(not_finite, 2);
}

TEST(Star, OnePixelImage) {
  Image image(1, 1, 3);
  setPixel(image, 0, 0, 9, 9, 9);
  applyStar(image, {});
  EXPECT_FLOAT_EQ(image.pixels[0], 9);
}

}  // namespace
}  // namespace glintmark
