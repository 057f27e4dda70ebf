#include "host/report/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "host/core/error.h"

namespace glintmark {
namespace {

Image rgb(std::vector<float> values) {
  Image image(static_cast<int>(values.size() / 3), 1, 3);
  image.pixels = std::move(values);
  return image;
}

TEST(Metrics, IdenticalImagesHaveNoError) {
  const Image image = rgb({1, 2, 3, 0, 0.5f, 9});
  EXPECT_EQ(relativeBias(image, image), 0);
  EXPECT_EQ(relMse(image, image), 0);
  EXPECT_EQ(colourError(image, image), 0);
}

TEST(Metrics, RelativeBiasByHand) {
  EXPECT_NEAR(relativeBias(rgb({1, 2, 3}), rgb({1, 1, 2})), 0.5, 1e-15);
  EXPECT_NEAR(relativeBias(rgb({1, 1, 2}), rgb({1, 2, 3})), -1.0 / 3, 1e-15);
  EXPECT_EQ(relativeBias(rgb({1, 1, 1}), rgb({0, 0, 0})), std::numeric_limits<double>::infinity());
  EXPECT_EQ(relativeBias(rgb({0, 0, 0}), rgb({0, 0, 0})), 0);
}

TEST(Metrics, RelMseByHand) {
  // (1 / (4 + 0.01) + 0 + 4 / (1 + 0.01)) / 3
  EXPECT_NEAR(relMse(rgb({3, 1, 3}), rgb({2, 1, 1})), (1 / 4.01 + 4 / 1.01) / 3, 1e-12);
  EXPECT_NEAR(relMse(rgb({1, 0, 0}), rgb({0, 0, 0})), 100.0 / 3, 1e-12);
}

TEST(Metrics, ColourErrorByHand) {
  EXPECT_NEAR(colourError(rgb({1, 1, 1}), rgb({0, 0, 0})), 1, 1e-12);
  EXPECT_NEAR(colourError(rgb({0.5f, 0, 0}), rgb({0, 0, 0})), 0.5 / std::sqrt(3), 1e-12);
  // Mean of 1 and 0; values beyond the display do not count.
  EXPECT_NEAR(colourError(rgb({9, 9, 9, 5, 5, 5}), rgb({0, -1, 0, 1, 1, 1})), 0.5, 1e-12);
}

TEST(Metrics, AlphaIsNotColour) {
  Image a(1, 1, 4), b(1, 1, 4);
  a.pixels = {1, 2, 3, 0};
  b.pixels = {1, 2, 3, 1};
  EXPECT_EQ(relMse(a, b), 0);
  EXPECT_EQ(relativeBias(a, b), 0);
}

TEST(Metrics, BadInputsAreErrors) {
  EXPECT_THROW(relMse(rgb({1, 1, 1}), rgb({1, 1, 1, 1, 1, 1})), Error);
  EXPECT_THROW(relMse(Image(), Image()), Error);
  EXPECT_THROW(relMse(rgb({std::nanf(""), 1, 1}), rgb({1, 1, 1})), Error);
  EXPECT_THROW(relativeBias(rgb({1, 1, 1}), rgb({1, std::nanf(""), 1})), Error);
}

TEST(Metrics, BadValuesAreNegativeOrNotFinite) {
  EXPECT_TRUE(isSane(rgb({0, 1, 1e30f})));
  const Image bad = rgb({-1e-30f, std::nanf(""), std::numeric_limits<float>::infinity()});
  EXPECT_EQ(badValueCount(bad), 3u);
  EXPECT_FALSE(isSane(bad));
}

TEST(Metrics, RadianceThatIsNotToBeMeasuredSaysWhy) {
  Image radiance(2, 1, 4);
  radiance.pixels = {0, 0, 0, 1, 0, 0, 0, 1};  // covered, and black
  EXPECT_EQ(radianceFault(radiance), "nothing that the view shows reflects light to it");
  radiance.pixels[6] = 1e-30f;
  EXPECT_EQ(radianceFault(radiance), "");
  radiance.pixels[1] = -1;
  EXPECT_EQ(radianceFault(radiance), "1 radiance values are negative or not finite");
}

TEST(Metrics, CoveredPixelsOfAnImageAndOfAnother) {
  Image image(3, 1, 4), errors(3, 1, 3);
  image.pixels = {1, 2, 3, 1, 4, 5, 6, 0, 7, 8, 9, 1};
  errors.pixels = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f};
  const Image row = coveredPixels(image);
  EXPECT_EQ(row.width, 2);
  EXPECT_EQ(row.height, 1);
  EXPECT_EQ(row.pixels, (std::vector<float>{1, 2, 3, 7, 8, 9}));
  EXPECT_EQ(coveredPixels(errors, image).pixels,
            (std::vector<float>{0.1f, 0.2f, 0.3f, 0.7f, 0.8f, 0.9f}));
}

}  // namespace
}  // namespace glintmark
