#include "host/report/difference/image_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/report/difference/difference_picture.h"
#include "host/report/picture/colour_map.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

// A row of greys of radiance.
Image greys(std::vector<float> values) {
  Image image(static_cast<int>(values.size()), 1, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = values[i / 3];
  return image;
}

TEST(PixelErrors, TrimmingLeavesOutTheWorst) {
  const std::vector<float> sorted = {1, 2, 3, 4, 90};
  EXPECT_EQ(meanOf(sorted), 20);
  EXPECT_EQ(trimmedMean(sorted, 0.2), 2.5);
  EXPECT_EQ(trimmedMean(sorted, 0.19), 20);
  EXPECT_TRUE(std::isnan(meanOf({})));
  EXPECT_EQ(quantileOf(sorted, 0.5), 3);
  EXPECT_EQ(quantileOf(sorted, 1), 90);
  EXPECT_DOUBLE_EQ(quantileOf(sorted, 0.875), 47);
}

TEST(ImageDifference, MetricsByHand) {
  const ImageDifference d = differenceOf(greys({0, 0, 3, 0, 1}), greys({0, 0, 2, 1, 1}), {});
  EXPECT_TRUE(d.is_radiance);
  EXPECT_DOUBLE_EQ(d.lit_share, 0.6);
  EXPECT_NEAR(d.metric("bias").all, 0, 1e-12);
  const double mape = 1 / 2.01 + 1 / 1.01, relmse = 1 / 4.01 + 1 / 1.01;
  EXPECT_NEAR(d.metric("mape").all, mape / 5, 1e-6);
  EXPECT_NEAR(d.metric("mape").lit, mape / 3, 1e-6);
  EXPECT_NEAR(d.metric("relmse").all, relmse / 5, 1e-6);
  EXPECT_NEAR(d.metric("relmse").lit, relmse / 3, 1e-6);
  EXPECT_TRUE(std::isnan(d.metric("ssim").all));  // a row of pixels has no window
  ASSERT_TRUE(d.ratios.largest);
  EXPECT_NEAR(d.ratios.largest->ratio, 1.5, 1e-6);
  EXPECT_EQ(d.ratios.largest->x, 2);
  EXPECT_EQ(d.ratios.only_image, 0u);
  EXPECT_EQ(d.ratios.only_reference, 1u);
  EXPECT_NEAR(d.quantiles.at(0).values.back(), 1, 1e-6);
  EXPECT_THROW(d.metric("psnr"), Error);
  const ImageDifference trimmed =
      differenceOf(greys({0, 0, 3, 0, 1}), greys({0, 0, 2, 1, 1}), {.trim = 0.34});
  EXPECT_NEAR(trimmed.metric("relmse_trimmed").all, 1 / 4.01 / 4, 1e-6);
  EXPECT_NEAR(trimmed.metric("relmse_trimmed").lit, 1 / 4.01 / 2, 1e-6);
}

TEST(ImageDifference, SparseGlintsAreNotLostInBlack) {
  Image picture(96, 96, 3), reference(96, 96, 3);
  for (std::size_t c = 0; c < 3; ++c) reference.at(48, 48)[c] = 40;
  const ImageDifference d = differenceOf(picture, reference, {});
  for (const char* metric : {"flip", "hdr_flip", "mape"}) {
    EXPECT_LT(d.metric(metric).all, 0.06) << metric;
    EXPECT_GT(d.metric(metric).lit, 0.5) << metric;
  }
}

TEST(ImageDifference, PicturesOfDisplayValuesAreComparedInLinearLight) {
  Image picture = greys({0.5f}), reference = greys({1});
  picture.step = reference.step = 1.0f / 255;
  const ImageDifference d = differenceOf(picture, reference, {});
  EXPECT_FALSE(d.is_radiance);
  EXPECT_FALSE(d.hdr_flip);
  EXPECT_NEAR(d.metric("bias").all, std::pow((0.5 + 0.055) / 1.055, 2.4) - 1, 1e-6);
}

TEST(ImageDifference, WhatCannotBeComparedIsSaid) {
  const auto message = [](const Image& a, const Image& b) {
    return messageOf<Error>([&] { differenceOf(a, b, {}); });
  };
  EXPECT_EQ(message(greys({1, 2}), greys({1})),
            "the pictures have 2x1 and 1x1 pixels, expected two of one size");
  Image display = greys({1});
  display.step = 1.0f / 255;
  EXPECT_EQ(message(display, greys({1})),
            "the first picture holds display values, the other radiance; expected two .png, or two "
            ".exr");
  EXPECT_NE(message(greys({std::nanf("")}), greys({1})).find("(0, 0) is not finite"),
            std::string::npos);
}

TEST(ImageDifference, JsonHasNoNumbersThatAreNone) {
  const ImageDifference d = differenceOf(greys({1, 2}), greys({2, 2}), {});
  const auto json = nlohmann::json::parse(differenceJson(d, "a.exr", "b.exr"));
  EXPECT_EQ(json["schema"], "glintmark.difference/1");
  EXPECT_EQ(json["reference"], "b.exr");
  EXPECT_DOUBLE_EQ(json["metrics"]["bias"]["all"], -0.25);
  EXPECT_TRUE(json["metrics"]["ssim"]["all"].is_null());
  EXPECT_NEAR(json["quantiles"]["absolute"]["0.5"], 0.5, 1e-6);
  EXPECT_EQ(json["largest_ratio"]["x"], 0);
}

TEST(DifferencePicture, KeepsTheMapAndItsColours) {
  Image map(400, 10, 1);
  map.at(3, 4)[0] = 2;
  const Image picture = differencePicture(map, 2, "error");
  EXPECT_EQ(picture.width, 400);
  EXPECT_GT(picture.height, 30);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(picture.at(3, 4)[c], falseColour(1)[c]);
    EXPECT_EQ(picture.at(4, 4)[c], falseColour(0)[c]);
  }
  const Image layers = differenceLayers(map, 2, "error", "flip");
  EXPECT_EQ(layers.channel_names.at(3), "flip");
  EXPECT_EQ(layers.at(3, 4)[3], 2);
  EXPECT_EQ(layers.at(399, picture.height - 1)[3], 0);
}

}  // namespace
}  // namespace glintmark
