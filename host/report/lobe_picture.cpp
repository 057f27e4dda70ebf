#include "host/report/lobe_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/report/colour_map.h"
#include "host/report/text_drawing.h"

namespace glintmark {
namespace {

constexpr int kRadius_px = 96, kMargin_px = 8, kCaption_px = 22;
constexpr int kTile_px = 2 * (kRadius_px + kMargin_px);
constexpr DisplayColour kPaper = {1, 1, 1}, kInk = {0.1f, 0.1f, 0.1f};

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

}  // namespace

Image lobePicture(const std::vector<LobeDisc>& discs, int columns) {
  const int count = static_cast<int>(discs.size());
  const int rows = (count + columns - 1) / columns;
  Image image(kTile_px * std::min(columns, count), (kTile_px + kCaption_px) * rows, 3);
  fillRect(image, 0, 0, image.width, image.height, kPaper);
  for (int i = 0; i < count; ++i) {
    const int left = i % columns * kTile_px, top = i / columns * (kTile_px + kCaption_px);
    drawDisc(image, left + kMargin_px, top + kMargin_px, discs[static_cast<std::size_t>(i)]);
    const std::string& caption = discs[static_cast<std::size_t>(i)].caption;
    drawText(image, left + (kTile_px - textWidth(caption, 1)) / 2, top + kTile_px, caption, 1,
             kInk);
  }
  return image;
}

Image histogramPicture(const Simulation& simulation) {
  std::vector<LobeDisc> discs;
  const int sides = simulation.settings.kind == SurfaceKind::kDielectric ? 2 : 1;
  for (int side = 0; side < sides; ++side)
    for (int order = 1; order <= simulation.settings.orders; ++order)
      discs.push_back(
          {fmt::format("order {}{}: {:.4f}", order, side == 0 ? "" : " below",
                       static_cast<double>(simulation.left(side, order)) /
                           static_cast<double>(std::max<std::uint64_t>(simulation.rays_done, 1))),
           [&simulation, side, order](double cosine, double azimuth) {
             const auto row = static_cast<std::size_t>((1 - cosine) * HF_COSINES);
             const auto column =
                 static_cast<std::size_t>(azimuth / (2 * std::numbers::pi) * HF_AZIMUTHS);
             return static_cast<double>(
                 simulation.cell(side, order, std::min<std::size_t>(row, HF_COSINES - 1),
                                 std::min<std::size_t>(column, HF_AZIMUTHS - 1)));
           }});
  return lobePicture(discs, simulation.settings.orders);
}

}  // namespace glintmark
