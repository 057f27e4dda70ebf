// Pictures of tables show every entry in its place and colour.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/report/picture/colour_map.h"
#include "host/report/picture/matrix_picture.h"

namespace glintmark {
namespace {

bool hasColour(const Image& picture, const DisplayColour& colour) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (std::ranges::equal(picture.at(x, y), colour)) return true;
    }
  }
  return false;
}

MatrixPictureOptions twoByTwo() {
  return {.width = 2, .height = 2, .entry_px = 40, .low = 0, .high = 2, .title = "t"};
}

TEST(MatrixPicture, EntriesFollowEachOtherRowByRow) {
  const std::vector<double> values = {0, 1, 2, 5};
  const Image picture = matrixPicture({{"panel", values}}, twoByTwo());
  // The first pixel that is neither paper nor ink is the corner of the first entry.
  int x0 = 0, y0 = 0;
  for (int y = picture.height - 1; y >= 0; --y) {
    for (int x = picture.width - 1; x >= 0; --x) {
      if (std::ranges::equal(picture.at(x, y), falseColour(0)) && y < 60) x0 = x, y0 = y;
    }
  }
  EXPECT_TRUE(std::ranges::equal(picture.at(x0 + 60, y0 + 20), falseColour(0.5)));
  EXPECT_TRUE(std::ranges::equal(picture.at(x0 + 20, y0 + 60), falseColour(1)));
  EXPECT_TRUE(std::ranges::equal(picture.at(x0 + 60, y0 + 60), falseColour(1)));
}

TEST(MatrixPicture, PanelsStandSideBySide) {
  const std::vector<double> low(4, 0.0), middle(4, 1.0);
  const Image one = matrixPicture({{"a", low}}, twoByTwo());
  const Image two = matrixPicture({{"a", low}, {"b", middle}}, twoByTwo());
  EXPECT_EQ(two.height, one.height);
  EXPECT_GE(two.width, one.width + 80);
  EXPECT_TRUE(hasColour(two, falseColour(0.5)));
}

TEST(MatrixPicture, RefusesPanelsOfAnotherSize) {
  const std::vector<double> three(3, 0.0);
  EXPECT_THROW(matrixPicture({{"a", three}}, twoByTwo()), Error);
}

}  // namespace
}  // namespace glintmark
