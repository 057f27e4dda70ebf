#include "host/report/picture/text_drawing.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "host/report/picture/text_coverage.h"

namespace glintmark {
namespace {

constexpr int kLeastSize_px = 8;

// What is drawn: no blanks at the end, one question mark for each character that is not ASCII,
// whatever the count of its bytes in UTF-8. OpenImageIO 2.4 takes other letters for these.
std::string printable(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(' ') + 1);
  std::string out;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x80)
      out += character;
    else if (byte >= 0xC0)
      out += '?';
  }
  return out;
}

TextCoverage coverageOf(std::string_view text, const TextStyle& style) {
  return textCoverage(
      printable(text), style.size_px,
      style.weight == TextWeight::kBold ? GLINTMARK_FONT_BOLD : GLINTMARK_FONT_REGULAR);
}

}  // namespace

int textSizeFor(int picture_width_px) {
  return std::clamp(static_cast<int>(std::lround(picture_width_px / 68.0)), 12, 40);
}

void fillRect(Image& image, int x, int y, int width, int height, const DisplayColour& colour) {
  for (int py = std::max(y, 0); py < std::min(y + height, image.height); ++py) {
    for (int px = std::max(x, 0); px < std::min(x + width, image.width); ++px) {
      std::ranges::copy(colour, image.at(px, py).begin());
    }
  }
}

void blendPixel(Image& image, int x, int y, const DisplayColour& colour, float share) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const std::span<float> pixel = image.at(x, y);
  for (std::size_t c = 0; c < colour.size(); ++c)
    pixel[c] = std::lerp(pixel[c], colour[c], std::min(share, 1.0f));
}

void drawText(Image& image, int x, int baseline_y, std::string_view text, const TextStyle& style,
              TextAlign align) {
  const TextCoverage ink = coverageOf(text, style);
  const int width = ink.left + ink.share.width;
  if (align == TextAlign::kCentre) x -= width / 2;
  if (align == TextAlign::kRight) x -= width;
  for (int row = 0; row < ink.share.height; ++row)
    for (int column = 0; column < ink.share.width; ++column)
      blendPixel(image, x + ink.left + column, baseline_y + ink.top + row, style.colour,
                 ink.share.at(column, row)[0]);
}

void drawTurnedText(Image& image, int x, int y, std::string_view text, const TextStyle& style,
                    TextTurn turn) {
  const TextCoverage ink = coverageOf(text, style);
  // The middle of the line is half the height of small letters above the baseline.
  const int middle = -style.size_px / 4, sign = turn == TextTurn::kDownwards ? 1 : -1;
  for (int row = 0; row < ink.share.height; ++row)
    for (int column = 0; column < ink.share.width; ++column)
      blendPixel(image, x - sign * (ink.top + row - middle),
                 y + sign * (column - ink.share.width / 2), style.colour,
                 ink.share.at(column, row)[0]);
}

int textWidth(std::string_view text, const TextStyle& style) {
  const TextCoverage ink = coverageOf(text, style);
  return std::max(ink.left + ink.share.width, 0);
}

TextStyle fitted(TextStyle style, std::string_view text, int width_px) {
  while (style.size_px > kLeastSize_px && textWidth(text, style) > width_px) --style.size_px;
  return style;
}

}  // namespace glintmark
