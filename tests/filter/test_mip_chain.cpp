// Mip chains against OpenImageIO and against the mean that every level must keep.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <random>

#include "host/core/error.h"
#include "host/filter/mip_chain.h"

namespace glintmark {
namespace {

// Sums of up to 64 x 64 values in [0, 1] in single precision on OpenImageIO's side.
constexpr float kOracleTolerance = 1e-5f;
// Means of values in [0, 1] rounded to single precision once per level.
constexpr double kMeanTolerance = 1e-6;

Image noise(int width, int height, int channels) {
  Image image(width, height, channels);
  std::mt19937 random(5);
  for (float& value : image.pixels) value = static_cast<float>(random() * 0x1p-32);
  return image;
}

double mean(const Image& image, int channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += image.channels) {
    sum += image.pixels[i];
  }
  return sum * image.channels / static_cast<double>(image.pixels.size());
}

TEST(MipChain, AgreesWithOpenImageIoWhereTexelsNest) {
  const Image finest = noise(64, 32, 3);
  OIIO::ImageBuf source(OIIO::ImageSpec(64, 32, 3, OIIO::TypeDesc::FLOAT));
  source.set_pixels(source.roi(), OIIO::TypeDesc::FLOAT, finest.pixels.data());
  const MipChain chain = makeMipChain(finest);
  ASSERT_EQ(chain.levels.size(), 7u);
  for (int level = 1; level <= 5; ++level) {
    const Image& image = chain.levels[level];
    const OIIO::ROI roi(0, 64 >> level, 0, 32 >> level, 0, 1, 0, 3);
    const OIIO::ImageBuf resized = OIIO::ImageBufAlgo::resize(source, "box", 0.0f, roi);
    std::vector<float> expected(image.pixels.size());
    ASSERT_TRUE(resized.get_pixels(roi, OIIO::TypeDesc::FLOAT, expected.data()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_NEAR(image.pixels[i], expected[i], kOracleTolerance) << "level " << level;
    }
  }
}

TEST(MipChain, KeepsTheMeanAtAnySize) {
  for (const auto& [width, height] : {std::pair{37, 23}, {1, 1}, {1, 100}, {63, 1}, {48, 5}}) {
    const MipChain chain = makeMipChain(noise(width, height, 2));
    for (const Image& level : chain.levels) {
      for (int c = 0; c < 2; ++c) {
        EXPECT_NEAR(mean(level, c), mean(chain.levels[0], c), kMeanTolerance)
            << width << "x" << height << " at " << level.width << "x" << level.height;
      }
    }
    EXPECT_EQ(chain.levels.back().pixels.size(), 2u);
  }
}

TEST(MipChain, WeighsTexelsByTheAreaTheyShare) {
  Image three(3, 1, 1);
  three.pixels = {1, 10, 100};
  EXPECT_NEAR(makeMipChain(three).levels[1].pixels[0], 37, 1e-5);
  Image five(5, 1, 1);
  five.pixels = {1, 2, 4, 8, 16};
  const Image half = makeMipChain(five).levels[1];
  EXPECT_NEAR(half.pixels[0], (1 + 2 + 0.5 * 4) / 2.5, 1e-6);
  EXPECT_NEAR(half.pixels[1], (0.5 * 4 + 8 + 16) / 2.5, 1e-6);
  EXPECT_THROW(makeMipChain(Image()), Error);
}

}  // namespace
}  // namespace glintmark
