#include "host/report/difference/difference_picture.h"

#include <algorithm>

#include "host/report/picture/colour_map.h"
#include "host/report/picture/colour_scale.h"
#include "host/report/picture/text_drawing.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

constexpr int kNarrowestLegend_px = 320;

// Digits behind the point so that a fifth of the scale can be read.
int decimalsFor(double top) {
  int decimals = 1;
  for (double step = top / 5; step < 0.1 && decimals < 9; step *= 10) ++decimals;
  return top >= 50 ? 0 : decimals;
}

}  // namespace

Image differencePicture(const Image& map, double top, const std::string& title) {
  const int width = std::max(map.width, kNarrowestLegend_px), text = textSizeFor(width);
  const int bar = text * 9 / 4, legend = bar + colourScaleHeight(text) + text * 4 / 5;
  Image picture(width, map.height + legend, 3);
  fillRect(picture, 0, 0, picture.width, picture.height, kPaper);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      std::ranges::copy(falseColour(map.at(x, y)[0] / top), picture.at(x, y).begin());
  const TextStyle style =
      fitted({.size_px = text * 5 / 4, .weight = TextWeight::kBold}, title, width - 2 * text);
  drawText(picture, text, map.height + text * 7 / 4, title, style);
  drawColourScale(picture, text, map.height + bar, width - 2 * text,
                  {.low = 0, .high = top, .decimals = decimalsFor(top)}, text);
  return picture;
}

Image differenceLayers(const Image& map, double top, const std::string& title,
                       const std::string& name) {
  const Image picture = differencePicture(map, top, title);
  Image layers(picture.width, picture.height, 4);
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x) {
      std::ranges::transform(picture.at(x, y), layers.at(x, y).begin(), decodeSrgb);
      if (x < map.width && y < map.height) layers.at(x, y)[3] = map.at(x, y)[0];
    }
  layers.channel_names = {"R", "G", "B", name};
  return layers;
}

}  // namespace glintmark
