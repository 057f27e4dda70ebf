#include "host/report/picture/colour_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

int barHeight(int size_px) {
  return size_px * 3 / 4;
}
int tickHeight(int size_px) {
  return std::max(3, size_px / 3);
}

std::string label(double value, int decimals) {
  if (decimals < 0) decimals = value == std::floor(value) ? 0 : 1;
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

int colourScaleHeight(int size_px) {
  return barHeight(size_px) + tickHeight(size_px) + size_px;
}

void drawColourScale(Image& image, int x, int y, int width, const ColourScale& scale, int size_px) {
  for (int i = 0; i < width; ++i)
    fillRect(image, x + i, y, 1, barHeight(size_px), falseColour(i / (width - 1.0)));
  const TextStyle style{.size_px = size_px, .colour = kSoftInk};
  const int tick_width = std::max(1, size_px / 12), bottom = y + barHeight(size_px);
  for (int i = 0; i <= scale.intervals; ++i) {
    const double t = static_cast<double>(i) / scale.intervals;
    const int at = x + static_cast<int>(std::lround(t * (width - tick_width)));
    fillRect(image, at, bottom, tick_width, tickHeight(size_px), kSoftInk);
    const std::string text = label(std::lerp(scale.low, scale.high, t), scale.decimals);
    // The first and the last label end with the bar.
    const TextAlign align = i == 0                 ? TextAlign::kLeft
                            : i == scale.intervals ? TextAlign::kRight
                                                   : TextAlign::kCentre;
    const int label_x = i == scale.intervals ? x + width : align == TextAlign::kLeft ? x : at;
    drawText(image, label_x, y + colourScaleHeight(size_px), text, style, align);
  }
}

}  // namespace glintmark
