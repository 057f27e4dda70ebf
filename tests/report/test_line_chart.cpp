// Line charts put data where they belong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/core/error.h"
#include "host/report/picture/line_chart.h"
#include "host/report/picture/picture_strip.h"

namespace glintmark {
namespace {

constexpr DisplayColour kRed = {1, 0, 0};

struct Extent {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1, count = 0;
};

// Where a colour is, above the legend.
Extent extentOf(const Image& image, const DisplayColour& colour, int height) {
  Extent e;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (std::ranges::equal(image.at(x, y), colour)) {
        e.left = std::min(e.left, x), e.right = std::max(e.right, x);
        e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
        ++e.count;
      }
  return e;
}

const ChartOptions kOptions{.columns = 2, .panel_width_px = 200, .panel_height_px = 120};

TEST(LineChart, ALineRunsFromItsFirstPointToItsLast) {
  const Image chart = lineChart({{"t", {{"s", kRed, {0, 1}, {0, 1}}}}}, kOptions);
  EXPECT_EQ(chart.width, 200);
  const Extent e = extentOf(chart, kRed, 120);
  EXPECT_GT(e.right - e.left, 130);
  EXPECT_GT(e.bottom - e.top, 60);
  // It rises to the right: the highest point is the rightmost.
  EXPECT_TRUE(std::ranges::equal(chart.at(e.right, e.top), kRed));
}

TEST(LineChart, PointsThatAreNotFiniteLeaveAGap) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Image whole = lineChart({{"t", {{"s", kRed, {0, 0.5, 1}, {1, 1, 1}}}}}, kOptions);
  const Image gap =
      lineChart({{"t", {{"s", kRed, {0, 0.3, 0.5, 0.7, 1}, {1, 1, nan, 1, 1}}}}}, kOptions);
  const int all = extentOf(whole, kRed, 120).count, some = extentOf(gap, kRed, 120).count;
  EXPECT_LT(some, 0.7 * all);
  EXPECT_GT(some, 0.5 * all);
}

TEST(LineChart, PanelsWrapIntoRows) {
  const ChartPanel panel{"t", {{"s", kRed, {0, 1}, {1, 1}}}};
  const Image one = lineChart({panel}, kOptions),
              three = lineChart({panel, panel, panel}, kOptions);
  EXPECT_EQ(three.width, 400);
  EXPECT_EQ(three.height, one.height + 120);
}

TEST(LineChart, RefusesWhatItCannotDraw) {
  EXPECT_THROW(lineChart({}, kOptions), Error);
  EXPECT_THROW(lineChart({{"t", {{"s", kRed, {0, 1}, {1}}}}}, kOptions), Error);
  EXPECT_THROW(lineChart({{"t", {}, 1, 1}}, kOptions), Error);
}

// Equal factors are equal lengths, and what is not above 0 has no place.
TEST(LineChart, LogarithmicAxesKeepFactors) {
  ChartOptions options = kOptions;
  options.scale = ChartScale::kLogarithmic;
  options.y_low = 0.01;
  options.y_high = 100;
  const auto middle = [&](double value) {
    const Extent e = extentOf(
        lineChart({{"t", {{"s", kRed, {value}, {value}, true}}, 0.01, 100}}, options), kRed, 120);
    return std::pair((e.left + e.right) / 2.0, (e.top + e.bottom) / 2.0);
  };
  const auto [x0, y0] = middle(0.1);
  const auto [x1, y1] = middle(1);
  const auto [x2, y2] = middle(10);
  EXPECT_NEAR(x2 - x1, x1 - x0, 1);
  EXPECT_NEAR(y1 - y2, y0 - y1, 1);
  EXPECT_GT(x1 - x0, 25);
  EXPECT_EQ(
      extentOf(lineChart({{"t", {{"s", kRed, {1}, {0}, true}}, 0.01, 100}}, options), kRed, 120)
          .count,
      0);
  EXPECT_THROW(lineChart({{"t", {}, 0, 1}}, options), Error);
}

// Pixels and SVG are drawn by the same calls; what SVG adds is its syntax.
TEST(LineChart, SvgHasTheSamePointsAndItsTextEscaped) {
  const std::string svg = lineChartSvg({{"a < b & c", {{"s", kRed, {0, 1}, {0, 1}}}}}, kOptions);
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\"")) << svg;
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find(">a &lt; b &amp; c</text>"), std::string::npos);
  EXPECT_NE(svg.find("stroke=\"#ff0000\""), std::string::npos);
  EXPECT_NE(svg.find("points=\"46.00,96.00 184.00,30.00\""), std::string::npos) << svg;
}

TEST(PictureColumn, StacksPicturesOfAnyWidth) {
  Image wide(4, 2, 3), narrow(2, 3, 3);
  std::ranges::fill(narrow.pixels, 0.5f);
  const Image column = pictureColumn({wide, narrow});
  EXPECT_EQ(column.width, 4);
  EXPECT_EQ(column.height, 5);
  EXPECT_EQ(column.at(1, 3)[0], 0.5f);
  EXPECT_EQ(column.at(3, 3)[0], 1);
  EXPECT_THROW(pictureColumn({}), Error);
}

}  // namespace
}  // namespace glintmark
