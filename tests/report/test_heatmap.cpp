#include "host/report/picture/heatmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "host/core/error.h"
#include "host/report/picture/colour_map.h"
#include "host/report/picture/text_drawing.h"
#include "tests/report/widest_line.h"

namespace glintmark {
namespace {

Image cellsOf(int width, int height, std::vector<float> values) {
  Image image(width, height, 1);
  image.pixels = std::move(values);
  return image;
}

DisplayColour colourAt(const Image& image, int x, int y) {
  const auto pixel = image.at(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

TEST(CellDistribution, ByHand) {
  const CellDistribution d = cellDistribution(cellsOf(3, 2, {-1, 8, 10, 8, 14, 0}));
  EXPECT_EQ(d.glint_px, 4u);
  EXPECT_EQ(d.min, 8);
  EXPECT_EQ(d.max, 14);
  EXPECT_EQ(d.mean, 10);
  ASSERT_EQ(d.pixels_by_count.size(), 15u);
  EXPECT_EQ(d.pixels_by_count[8], 2u);
  EXPECT_EQ(d.pixels_by_count[14], 1u);
}

TEST(CellDistribution, NoGlintPixels) {
  const CellDistribution d = cellDistribution(cellsOf(2, 1, {-1, 0}));
  EXPECT_EQ(d.glint_px, 0u);
  EXPECT_EQ(d.mean, 0);
  EXPECT_NE(histogramText(d).find("no pixel of the image visits"), std::string::npos);
}

TEST(Histogram, CountsEveryPixelOnce) {
  Image cells(100, 40, 1);
  for (std::size_t i = 0; i < cells.pixels.size(); ++i) {
    cells.pixels[i] = static_cast<float>(8 + i * i % 57);
  }
  std::istringstream text(histogramText(cellDistribution(cells)));
  std::string line;
  std::getline(text, line);  // header
  std::size_t total = 0;
  double percent = 0;
  while (std::getline(text, line)) {
    EXPECT_LE(line.size(), 100u);
    std::istringstream fields(line);
    std::string range, share;
    std::size_t pixels = 0;
    fields >> range >> pixels >> share;
    total += pixels;
    percent += std::stod(share);
  }
  EXPECT_EQ(total, cells.pixels.size());
  EXPECT_NEAR(percent, 100, 0.2);  // two digits on at most 16 lines
}

TEST(Histogram, OneValueAndHugeValues) {
  EXPECT_NE(histogramText(cellDistribution(cellsOf(2, 1, {8, 8}))).find("100.00%"),
            std::string::npos);
  const std::string text = histogramText(cellDistribution(cellsOf(2, 1, {8, 3e9f})));
  EXPECT_LT(text.size(), 3000u);
  for (const std::size_t columns : {40, 60}) {
    const std::string narrow = histogramText(cellDistribution(cellsOf(2, 1, {8, 9})), columns);
    EXPECT_LE(widestLine(narrow), columns);
  }
}

TEST(Heatmap, FixedScaleIsThePapers) {
  const Image colours = heatmapColours(cellsOf(7, 1, {8, 64, 36, 3, 900, 0, -1}), HeatmapRange{});
  EXPECT_EQ(colourAt(colours, 0, 0), falseColour(0));
  EXPECT_EQ(colourAt(colours, 1, 0), falseColour(1));
  EXPECT_EQ(colourAt(colours, 2, 0), falseColour(0.5));
  EXPECT_EQ(colourAt(colours, 3, 0), falseColour(0));
  EXPECT_EQ(colourAt(colours, 4, 0), falseColour(1));
  for (const int x : {5, 6}) {  // two different greys
    EXPECT_EQ(colours.at(x, 0)[0], colours.at(x, 0)[1]);
    EXPECT_EQ(colours.at(x, 0)[0], colours.at(x, 0)[2]);
  }
  EXPECT_NE(colours.at(5, 0)[0], colours.at(6, 0)[0]);
}

TEST(Heatmap, AutoScaleSpansTheImage) {
  const CellDistribution d = cellDistribution(cellsOf(3, 1, {-1, 10, 20}));
  const HeatmapRange range = heatmapRange(HeatmapScale::kAuto, d);
  EXPECT_EQ(range.low, 10);
  EXPECT_EQ(range.high, 20);
  const HeatmapRange flat =
      heatmapRange(HeatmapScale::kAuto, cellDistribution(cellsOf(1, 1, {12})));
  EXPECT_GT(flat.high, flat.low);
}

TEST(Heatmap, PictureKeepsPixelsAndAddsALegend) {
  Image cells(400, 50, 1);
  for (float& count : cells.pixels) count = 64;
  cells.at(7, 9)[0] = -1;
  const Image picture = heatmapPicture(cells, {.title = "snow/steep", .guard_hits = 12});
  EXPECT_EQ(picture.width, 400);
  EXPECT_GT(picture.height, 80);
  EXPECT_EQ(colourAt(picture, 8, 9), falseColour(1));
  const DisplayColour uncovered = colourAt(picture, 7, 9);
  EXPECT_EQ(uncovered[0], uncovered[1]);
  EXPECT_EQ(uncovered[0], uncovered[2]);

  // The colour bar runs from the first to the last colour in some row of the legend.
  bool bar_found = false;
  for (int y = 50; y < picture.height; ++y) {
    int left = 0, right = picture.width - 1;
    while (left < right && colourAt(picture, left, y) == kPaper) ++left;
    while (left < right && colourAt(picture, right, y) == kPaper) --right;
    bar_found |= right - left > 350 && colourAt(picture, left, y) == falseColour(0) &&
                 colourAt(picture, right, y) == falseColour(1);
  }
  EXPECT_TRUE(bar_found);
}

bool hasBlock(const Image& picture, int from_y, const DisplayColour& colour) {
  for (int y = from_y; y + 5 < picture.height; ++y)
    for (int x = 0; x + 5 < picture.width; ++x)
      if (colourAt(picture, x, y) == colour && colourAt(picture, x + 5, y + 5) == colour)
        return true;
  return false;
}

TEST(Heatmap, LegendNamesTheGreysThatThePictureHas) {
  Image cells(400, 50, 1);
  for (float& count : cells.pixels) count = 64;
  const auto swatches = [&](float value) {
    cells.at(0, 0)[0] = value;
    const Image greys = heatmapColours(cellsOf(2, 1, {0, -1}), HeatmapRange{});
    const Image picture = heatmapPicture(cells, {.title = "t"});
    return std::pair{hasBlock(picture, 50, colourAt(greys, 0, 0)),
                     hasBlock(picture, 50, colourAt(greys, 1, 0))};
  };
  EXPECT_EQ(swatches(64), (std::pair{false, false}));
  EXPECT_EQ(swatches(0), (std::pair{true, false}));
  EXPECT_EQ(swatches(-1), (std::pair{false, true}));
}

// Legends of earlier versions were 43 pixels high at this width, their bar 4 pixels from the edge.
TEST(Heatmap, EarlierPicturesAreReadBackToo) {
  const Image cells = cellsOf(2, 1, {8, 64});
  Image picture(330, 1 + 43, 3);
  fillRect(picture, 0, 0, picture.width, picture.height, kPaper);
  const Image colours = heatmapColours(cells, HeatmapRange{});
  std::ranges::copy(colours.at(0, 0), picture.at(0, 0).begin());
  std::ranges::copy(colours.at(1, 0), picture.at(1, 0).begin());
  for (int x = 0; x < 322; ++x) fillRect(picture, 4 + x, 28, 1, 10, falseColour(x / 321.0));
  EXPECT_EQ(heatmapDistribution(picture).pixels_by_count, cellDistribution(cells).pixels_by_count);
}

TEST(Heatmap, TinyImagesStillGetALegend) {
  const Image picture = heatmapPicture(cellsOf(1, 1, {8}), {.title = "x"});
  EXPECT_GE(picture.width, 300);
  EXPECT_EQ(colourAt(picture, 0, 0), falseColour(0));
  EXPECT_EQ(colourAt(picture, 100, 0), (DisplayColour{1, 1, 1}));
}

TEST(Heatmap, StripPutsPicturesSideBySide) {
  const std::vector<Image> cells = {cellsOf(2, 1, {8, 8}), cellsOf(2, 1, {64, 64})};
  const Image strip = heatmapStrip(cells, {"90", "1"}, HeatmapScale::kFixed, "plane");
  EXPECT_EQ(colourAt(strip, 1, 0), falseColour(0));
  EXPECT_EQ(colourAt(strip, 2, 0), falseColour(1));
  EXPECT_THROW(heatmapStrip(cells, {"90"}, HeatmapScale::kFixed, "plane"), Error);
  EXPECT_THROW(heatmapStrip({}, {}, HeatmapScale::kFixed, "plane"), Error);
}

}  // namespace
}  // namespace glintmark
