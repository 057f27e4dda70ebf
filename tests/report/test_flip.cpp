// FLIP and SSIM against other implementations and closed forms.
#include "host/report/difference/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "host/report/difference/ssim.h"

namespace glintmark {
namespace {

// Whole numbers over 101, so that any program makes the same picture.
Image pattern(int seed, int channels) {
  Image image(40, 32, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c)
        image.at(x, y)[static_cast<std::size_t>(c)] =
            static_cast<float>((7 * x + 13 * y + 29 * c + seed * x * y) % 101) / 101.0f;
  return image;
}

Image uniform(float r, float g, float b) {
  Image image(24, 20, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 3 == 0 ? r : i % 3 == 1 ? g : b;
  return image;
}

double mean(const Image& map) {
  return std::accumulate(map.pixels.begin(), map.pixels.end(), 0.0) /
         static_cast<double>(map.pixels.size());
}

struct PublishedFlip {
  double pixels_per_degree, mean, corner, middle, far_corner;
};

void expectFlip(const Image& map, const PublishedFlip& published) {
  EXPECT_NEAR(mean(map), published.mean, 2e-5);
  EXPECT_NEAR(map.at(0, 0)[0], published.corner, 1e-4);
  EXPECT_NEAR(map.at(20, 16)[0], published.middle, 1e-4);
  EXPECT_NEAR(map.at(39, 31)[0], published.far_corner, 1e-4);
}

// By the authors' program, flip-evaluator 1.7, of the same patterns as linear light.
TEST(Flip, AgreesWithTheAuthorsProgram) {
  for (const PublishedFlip& published :
       {PublishedFlip{kPixelsPerDegree, 0.2626536786556244, 0.044957082718610764,
                      0.4184225174453186, 0.45769786834716797},
        PublishedFlip{20, 0.7178924679756165, 0.00016501385834999382, 0.9746124148368835,
                      0.27111923694610596}})
    expectFlip(flipMap(pattern(1, 3), pattern(2, 3), published.pixels_per_degree), published);
}

TEST(Flip, OfRadianceAgreesWithTheAuthorsProgram) {
  Image a = pattern(1, 3), b = pattern(2, 3);
  for (Image* image : {&a, &b})
    for (float& value : image->pixels) value = value * value * value * value * 50;
  const std::optional<ExposureRange> exposures = exposureRange(b);
  ASSERT_TRUE(exposures);
  EXPECT_NEAR(exposures->first, -4.125448226928711, 1e-4);
  EXPECT_NEAR(exposures->last, -1.7528878450393677, 1e-4);
  EXPECT_EQ(exposures->count, 3);
  expectFlip(hdrFlipMap(a, b, *exposures, kPixelsPerDegree),
             {kPixelsPerDegree, 0.3114602863788605, 0.060249052941799164, 0.4617682695388794,
              0.598970353603363});
}

TEST(Flip, OfOneColourIsItsDistance) {
  EXPECT_EQ(mean(flipMap(pattern(1, 3), pattern(1, 3), kPixelsPerDegree)), 0);
  // Green and blue are the farthest apart: 1 by definition.
  EXPECT_NEAR(mean(flipMap(uniform(0, 1, 0), uniform(0, 0, 1), kPixelsPerDegree)), 1, 1e-5);
  // Linear grey 0.5 and black differ by its lightness alone, which 0.7 turns to less than the knee
  // of the curve or more.
  const double lightness = 116 * std::cbrt(0.5) - 16, farthest = 41.2760;
  const double raised = std::pow(lightness, 0.7), knee = 0.4 * farthest;
  const double expected =
      raised < knee ? raised * 0.95 / knee : 0.95 + 0.05 * (raised - knee) / (farthest - knee);
  EXPECT_NEAR(mean(flipMap(uniform(0.5f, 0.5f, 0.5f), uniform(0, 0, 0), kPixelsPerDegree)),
              expected, 1e-4);
}

TEST(Flip, ExposuresAreOfThePixelsThatAreNotBlack) {
  Image sparse(64, 64, 3);
  const float grey[] = {0.25f, 0.5f, 1, 2, 64};
  for (std::size_t i = 0; i < std::size(grey); ++i)
    for (std::size_t c = 0; c < 3; ++c) sparse.at(static_cast<int>(9 * i), 30)[c] = grey[i];
  const std::optional<ExposureRange> exposures = exposureRange(sparse);
  ASSERT_TRUE(exposures);
  EXPECT_NEAR(exposures->last - exposures->first, 6, 1e-5);  // 64 to the median of five, 1
  EXPECT_EQ(exposures->count, 6);
  EXPECT_FALSE(exposureRange(Image(8, 8, 3)));
}

// By scikit-image 0.26 with gaussian_weights, sigma=1.5, use_sample_covariance=False.
TEST(Ssim, AgreesWithScikitImage) {
  const Image map = ssimMap(pattern(1, 1), pattern(2, 1));
  double sum = 0;
  int pixels = 0;
  for (const float value : map.pixels)
    if (!std::isnan(value)) sum += value, ++pixels;
  EXPECT_EQ(pixels, (40 - 10) * (32 - 10));
  EXPECT_NEAR(sum / pixels, -0.021221326277494276, 2e-6);
  EXPECT_NEAR(map.at(20, 16)[0], 0.02913864, 1e-5);
  EXPECT_NEAR(map.at(5, 5)[0], 0.09054951, 1e-5);
}

TEST(Ssim, ByHand) {
  EXPECT_NEAR(ssimMap(pattern(1, 1), pattern(1, 1)).at(20, 16)[0], 1, 1e-6);
  Image a(11, 11, 1), b(11, 11, 1);
  for (float& value : a.pixels) value = 0.25f;
  for (float& value : b.pixels) value = 0.75f;
  const Image map = ssimMap(a, b);  // flat: only the means differ
  EXPECT_NEAR(map.at(5, 5)[0], (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-6);
  EXPECT_TRUE(std::isnan(map.at(4, 5)[0]));
}

}  // namespace
}  // namespace glintmark
