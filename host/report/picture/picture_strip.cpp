#include "host/report/picture/picture_strip.h"

#include <algorithm>

#include "host/core/error.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr int kEarlierNameHeight_px = 12;

int nameHeight(int strip_width_px) {
  return textSizeFor(strip_width_px) * 7 / 4;
}

}  // namespace

Image pictureStrip(const std::vector<std::pair<std::string, Image>>& pictures) {
  if (pictures.empty()) throw Error("a strip of pictures needs at least one");
  const int width = pictures.front().second.width, height = pictures.front().second.height;
  const int count = static_cast<int>(pictures.size());
  const int name_height = nameHeight(count * width);
  Image strip(count * width, height + name_height, 3);
  fillRect(strip, 0, 0, strip.width, strip.height, kPaper);
  const int size_px = textSizeFor(strip.width), margin = size_px / 3;
  int left = 0;
  for (const auto& [name, picture] : pictures) {
    if (picture.width != width || picture.height != height || picture.channels < 3)
      throw Error("the pictures of a strip must have one size and three channels");
    const TextStyle style = fitted({.size_px = size_px}, name, width - 2 * margin);
    drawText(strip, left + margin, size_px * 5 / 4, name, style);
    // What of a name is too long even at the least size.
    fillRect(strip, left + width, 0, strip.width - left - width, name_height, kPaper);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        std::ranges::copy(picture.at(x, y).first(3), strip.at(left + x, y + name_height).begin());
    left += width;
  }
  return strip;
}

int stripNameHeight(const Image& strip) {
  const bool earlier = strip.pixels.empty() || strip.at(0, 0)[0] == 0;
  return earlier ? kEarlierNameHeight_px : nameHeight(strip.width);
}

Image pictureColumn(const std::vector<Image>& pictures) {
  if (pictures.empty()) throw Error("a column of pictures needs at least one");
  int width = 0, height = 0;
  for (const Image& picture : pictures) {
    width = std::max(width, picture.width);
    height += picture.height;
  }
  Image column(width, height, 3);
  std::ranges::fill(column.pixels, 1.0f);
  int top = 0;
  for (const Image& picture : pictures) {
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        std::ranges::copy(picture.at(x, y).first(3), column.at(x, top + y).begin());
    top += picture.height;
  }
  return column;
}

}  // namespace glintmark
