#include "host/report/picture/picture_strip.h"

#include <algorithm>

#include "host/core/error.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr int kLabelHeight_px = 12;

}  // namespace

Image pictureStrip(const std::vector<std::pair<std::string, Image>>& pictures) {
  if (pictures.empty()) throw Error("a strip of pictures needs at least one");
  const int width = pictures.front().second.width, height = pictures.front().second.height;
  Image strip(width * static_cast<int>(pictures.size()), height + kLabelHeight_px, 3);
  int left = 0;
  for (const auto& [name, picture] : pictures) {
    if (picture.width != width || picture.height != height || picture.channels < 3)
      throw Error("the pictures of a strip must have one size and three channels");
    drawText(strip, left + 3, 2, name, 1, {1, 1, 1});
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        std::ranges::copy(picture.at(x, y).first(3),
                          strip.at(left + x, y + kLabelHeight_px).begin());
    left += width;
  }
  return strip;
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
