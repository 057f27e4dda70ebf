#include "host/experiment/msbrdf/lobe_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/report/picture/colour_map.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr int kRadius_px = 96, kMargin_px = 12, kCaption_px = 44;
constexpr int kTile_px = 2 * (kRadius_px + kMargin_px);
constexpr TextStyle kCaption{.size_px = 14}, kNote{.size_px = 13, .colour = kSoftInk};

void drawDisc(Image& image, int left, int top, const LobeDisc& disc) {
  const int side = 2 * kRadius_px;
  std::vector<double> values(static_cast<std::size_t>(side) * side, -1);
  double most = disc.most;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double u = (x + 0.5) / kRadius_px - 1, v = 1 - (y + 0.5) / kRadius_px;
      const double r2 = u * u + v * v;  // 1 - cosine: equal areas
      if (r2 >= 1) continue;
      const double azimuth = std::atan2(v, u);
      const double value =
          disc.value(1 - r2, azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth);
      values[static_cast<std::size_t>(y) * side + x] = value;
      if (disc.most <= 0) most = std::max(most, value);
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double value = values[static_cast<std::size_t>(y) * side + x];
      if (value < 0) continue;
      const DisplayColour colour = falseColour(most > 0 ? value / most : 0);
      std::ranges::copy(colour, image.at(left + x, top + y).begin());
    }
}

// Mixes half of the ink into a pixel.
void dot(Image& image, int x, int y, const DisplayColour& ink) {
  float* pixel = image.at(x, y).data();
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = (pixel[c] + ink[c]) / 2;
}

void drawCompass(Image& image, int left, int top, const LobeDisc& disc) {
  constexpr DisplayColour kWhite = {1, 1, 1};
  const int centre_x = left + kRadius_px, centre_y = top + kRadius_px;
  for (const double angle_deg : {30.0, 60.0}) {
    const double radius = kRadius_px * std::sqrt(1 - std::cos(angle_deg * std::numbers::pi / 180));
    for (int i = 0; i < 180; ++i) {  // dotted
      const double turn = 2 * std::numbers::pi * i / 180;
      dot(image, centre_x + static_cast<int>(std::lround(radius * std::cos(turn))),
          centre_y + static_cast<int>(std::lround(radius * std::sin(turn))), kWhite);
    }
  }
  const double radius = kRadius_px * std::sqrt(1 - disc.light_cosine);
  const int x = centre_x + static_cast<int>(std::lround(radius * std::cos(disc.light_azimuth)));
  const int y = centre_y - static_cast<int>(std::lround(radius * std::sin(disc.light_azimuth)));
  fillRect(image, x - 5, y - 1, 11, 3, kInk);
  fillRect(image, x - 1, y - 5, 3, 11, kInk);
  fillRect(image, x - 4, y, 9, 1, kWhite);
  fillRect(image, x, y - 4, 1, 9, kWhite);
}

}  // namespace

Image lobePicture(const std::vector<LobeDisc>& discs, int columns) {
  const int count = static_cast<int>(discs.size());
  const int rows = (count + columns - 1) / columns;
  Image image(kTile_px * std::min(columns, count), (kTile_px + kCaption_px) * rows, 3);
  fillRect(image, 0, 0, image.width, image.height, kPaper);
  for (int i = 0; i < count; ++i) {
    const int left = i % columns * kTile_px, top = i / columns * (kTile_px + kCaption_px);
    drawDisc(image, left + kMargin_px, top + kMargin_px, discs[static_cast<std::size_t>(i)]);
    const LobeDisc& disc = discs[static_cast<std::size_t>(i)];
    const int middle = left + kTile_px / 2, bottom = top + kTile_px;
    drawText(image, middle, bottom + 10, disc.caption, fitted(kCaption, disc.caption, kTile_px - 8),
             TextAlign::kCentre);
    drawText(image, middle, bottom + 28, disc.note, fitted(kNote, disc.note, kTile_px - 8),
             TextAlign::kCentre);
    if (disc.compass) drawCompass(image, left + kMargin_px, top + kMargin_px, disc);
  }
  return image;
}

}  // namespace glintmark
