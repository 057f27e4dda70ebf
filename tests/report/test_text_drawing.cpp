// Text of the pictures: real letters, digits of one width, errors where the font is missing.
#include "host/report/picture/text_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "host/core/error.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/picture/shape_drawing.h"
#include "host/report/picture/text_coverage.h"

namespace glintmark {
namespace {

constexpr DisplayColour kBlack = {0, 0, 0};

Image paper(int width, int height) {
  Image image(width, height, 3);
  fillRect(image, 0, 0, width, height, kPaper);
  return image;
}

Image drawn(const std::string& text, const TextStyle& style = {.colour = kBlack},
            TextAlign align = TextAlign::kLeft, int x = 10) {
  Image image = paper(80, 40);
  drawText(image, x, 24, text, style, align);
  return image;
}

struct Box {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
  double ink = 0;
};

Box inkOf(const Image& image) {
  Box box;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float dark = 1 - image.at(x, y)[0];
      box.ink += dark;
      if (dark < 0.02f) continue;
      box.left = std::min(box.left, x), box.right = std::max(box.right, x);
      box.top = std::min(box.top, y), box.bottom = std::max(box.bottom, y);
    }
  return box;
}

TEST(TextDrawing, EveryCharacterHasAGlyphOfItsOwn) {
  std::vector<Image> glyphs;
  for (char character = '!'; character <= '~'; ++character)
    glyphs.push_back(drawn(std::string(1, character), {.size_px = 20, .colour = kBlack}));
  for (std::size_t i = 0; i < glyphs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(glyphs[i].pixels, glyphs[j].pixels)
          << static_cast<char>('!' + i) << static_cast<char>('!' + j);
}

TEST(TextDrawing, StandsOnItsBaselineAndSmallLettersAreSmaller) {
  const TextStyle style{.size_px = 20, .colour = kBlack};
  const Box capital = inkOf(drawn("X", style)), small = inkOf(drawn("x", style)),
            tail = inkOf(drawn("p", style));
  EXPECT_NEAR(capital.bottom, 23, 1);  // the last row above the baseline
  EXPECT_NEAR(capital.bottom - capital.top + 1, 0.72 * 20, 1.5);
  EXPECT_GT(small.top, capital.top + 2);
  EXPECT_EQ(small.bottom, capital.bottom);
  EXPECT_GT(tail.bottom, capital.bottom + 2);
}

TEST(TextDrawing, DigitsAreEquallyWide) {
  for (const int size_px : {12, 19}) {
    const TextStyle style{.size_px = size_px};
    for (char digit = '0'; digit <= '9'; ++digit)
      EXPECT_NEAR(textWidth(std::string(12, digit) + "|", style),
                  textWidth(std::string(12, '8') + "|", style), 1)
          << digit;
  }
}

TEST(TextDrawing, AlignsAndIsAsWideAsItSays) {
  const std::string text = "8 cells";
  const int width = textWidth(text, {.size_px = 13});
  EXPECT_NEAR(inkOf(drawn(text)).right + 1 - 10, width, 1);
  EXPECT_NEAR(inkOf(drawn(text, {}, TextAlign::kRight, 70)).right + 1, 70, 1);
  const Box centred = inkOf(drawn(text, {}, TextAlign::kCentre, 40));
  EXPECT_NEAR(centred.left + centred.right, 80, 3);
  EXPECT_EQ(textWidth("", {}), 0);
  EXPECT_EQ(textWidth("   ", {}), 0);
  EXPECT_GT(textWidth(text, {.size_px = 13, .weight = TextWeight::kBold}), width);
}

TEST(TextDrawing, OutsideOfTheImageNothingHappens) {
  Image image = paper(8, 8);
  drawText(image, -30, 4, "wide text that leaves on both sides", {.colour = kBlack});
  drawTurnedText(image, 4, 4, "wide text that leaves on both sides", {}, TextTurn::kDownwards);
  EXPECT_GT(inkOf(image).ink, 0);
}

TEST(TextDrawing, TurnedTextIsTheSameInkTheOtherWayRound) {
  const TextStyle style{.size_px = 16, .colour = kBlack};
  Image level = paper(90, 90), down = level, up = level;
  drawText(level, 45, 49, "Lot 71", style, TextAlign::kCentre);
  drawTurnedText(down, 45, 45, "Lot 71", style, TextTurn::kDownwards);
  drawTurnedText(up, 45, 45, "Lot 71", style, TextTurn::kUpwards);
  const Box flat = inkOf(level);
  for (const Box& turned : {inkOf(down), inkOf(up)}) {
    EXPECT_NEAR(turned.ink, flat.ink, 1e-3);
    EXPECT_EQ(turned.bottom - turned.top, flat.right - flat.left);
    EXPECT_EQ(turned.right - turned.left, flat.bottom - flat.top);
    EXPECT_NEAR(turned.top + turned.bottom, 90, 3);
  }
  EXPECT_NE(down.pixels, up.pixels);
}

TEST(TextDrawing, FittedTextFits) {
  const std::string text = "a caption that is too long";
  const TextStyle small = fitted({.size_px = 30}, text, 150);
  EXPECT_LT(small.size_px, 30);
  EXPECT_LE(textWidth(text, small), 150);
  EXPECT_GT(textWidth(text, {.size_px = small.size_px + 1}), 150);
  EXPECT_EQ(fitted({.size_px = 30}, "a", 150).size_px, 30);
  EXPECT_EQ(fitted({.size_px = 30}, text, 1).size_px, 8);
}

TEST(TextDrawing, WhatIsNotAsciiBecomesAQuestionMark) {
  EXPECT_EQ(drawn("a\u00b5b\u2212").pixels, drawn("a?b?").pixels);
}

TEST(TextCoverage, SaysWhichFontIsMissing) {
  try {
    textCoverage("text", 12, "/no/such/font.ttf");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/font.ttf"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("fonts-lato"), std::string::npos);
  }
  EXPECT_THROW(textCoverage("text", 12, "/proc/self/status"), Error) << "no font";
}

TEST(ShapeDrawing, LinesCoverTheirArea) {
  Image image = paper(60, 60);
  const std::vector<glm::dvec2> corner = {{10, 10.25}, {40, 10.25}, {40, 50.5}};
  drawPolyline(image, corner, 2, kBlack, {0, 0, 60, 60});
  const double joint = 2 * 2 / 4.0 * 0.9;  // the joint is in both arms, its outside is round
  EXPECT_NEAR(inkOf(image).ink, 2 * (30 + 40.25) + 3.14 - joint, 2.5);
  EXPECT_EQ(image.at(30, 10)[0], 0) << "the line is two pixels high and covers this one whole";
  Image clipped = paper(60, 60);
  drawPolyline(clipped, corner, 2, kBlack, {0, 0, 30, 60});
  EXPECT_EQ(inkOf(clipped).right, 29);
}

TEST(ShapeDrawing, DotsAreRound) {
  Image image = paper(20, 20);
  drawDot(image, {10, 10}, 5, kBlack, {0, 0, 20, 20});
  EXPECT_NEAR(inkOf(image).ink, 3.14159 * 25, 1.5);
  EXPECT_EQ(image.at(5, 5)[0], 1) << "outside the disc, inside its box";
}

TEST(PictureStrip, NamesStandAboveUntouchedPictures) {
  Image grey(90, 20, 3);
  std::ranges::fill(grey.pixels, 0.5f);
  const Image strip =
      pictureStrip({{"left", grey}, {"a much longer name than fits", grey}, {"", grey}});
  const int names = stripNameHeight(strip);
  EXPECT_EQ(strip.width, 270);
  EXPECT_EQ(strip.height, 20 + names);
  for (int y = names; y < strip.height; ++y)
    for (int x = 0; x < strip.width; ++x) ASSERT_EQ(strip.at(x, y)[1], 0.5f);
  // Long names end with their picture.
  const auto darkest = [&](int from, int to) {
    float least = 1;
    for (int y = 0; y < names; ++y)
      for (int x = from; x < to; ++x) least = std::min(least, strip.at(x, y)[0]);
    return least;
  };
  EXPECT_LT(darkest(0, 90), 0.5f);
  EXPECT_LT(darkest(90, 180), 0.5f);
  EXPECT_EQ(darkest(180, 270), 1);
  EXPECT_EQ(darkest(88, 90), 1) << "the first name is short";
}

TEST(PictureStrip, NamesOfEarlierStripsAreTwelvePixelsHigh) {
  Image strip(180, 32, 3);  // a black band with white letters above the pictures
  fillRect(strip, 3, 2, 5, 7, kPaper);
  EXPECT_EQ(stripNameHeight(strip), 12);
}

}  // namespace
}  // namespace glintmark
