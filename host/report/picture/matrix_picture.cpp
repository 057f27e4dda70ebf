#include "host/report/picture/matrix_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr DisplayColour kPaper = {1, 1, 1};
constexpr DisplayColour kInk = {0, 0, 0};
constexpr int kMarginPx = 12;
constexpr int kLinePx = kGlyphHeightPx + 5;
constexpr int kBarPx = 12;
constexpr int kTicks = 5;  // intervals on the colour bar

void drawPanel(Image& canvas, int x0, int y0, const MatrixPanel& panel,
               const MatrixPictureOptions& options) {
  const int side = options.entry_px;
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      const double value = panel.values[static_cast<std::size_t>(y) * options.width + x];
      fillRect(canvas, x0 + x * side, y0 + y * side, side, side,
               falseColour((value - options.low) / (options.high - options.low)));
    }
  }
}

void drawColourBar(Image& canvas, int y, const MatrixPictureOptions& options) {
  const int width = canvas.width - 2 * kMarginPx;
  drawText(canvas, kMarginPx, y, options.title, 1, kInk);
  y += kLinePx;
  for (int x = 0; x < width; ++x) {
    fillRect(canvas, kMarginPx + x, y, 1, kBarPx, falseColour(x / (width - 1.0)));
  }
  for (int tick = 0; tick <= kTicks; ++tick) {
    const double t = static_cast<double>(tick) / kTicks;
    const std::string label = fmt::format("{:.2f}", options.low + t * (options.high - options.low));
    const int centre = kMarginPx + static_cast<int>(t * (width - 1));
    const int label_width = textWidth(label, 1);
    fillRect(canvas, centre, y + kBarPx, 1, 3, kInk);
    drawText(canvas, std::clamp(centre - label_width / 2, 0, canvas.width - label_width),
             y + kBarPx + 5, label, 1, kInk);
  }
}

}  // namespace

Image matrixPicture(const std::vector<MatrixPanel>& panels, const MatrixPictureOptions& options) {
  const int width = options.width * options.entry_px, height = options.height * options.entry_px;
  const int count = static_cast<int>(panels.size());
  for (const MatrixPanel& panel : panels) {
    if (panel.values.size() != static_cast<std::size_t>(options.width) * options.height) {
      throw Error(fmt::format("the panel '{}' has {} values, expected {} x {}", panel.caption,
                              panel.values.size(), options.width, options.height));
    }
  }
  const int panels_bottom = kMarginPx + kLinePx + height;
  Image canvas(count * (width + kMarginPx) + kMarginPx,
               panels_bottom + 4 * kLinePx + 2 * kMarginPx + kBarPx, 3);
  fillRect(canvas, 0, 0, canvas.width, canvas.height, kPaper);
  for (int i = 0; i < count; ++i) {
    const int x0 = kMarginPx + i * (width + kMarginPx);
    drawText(canvas, x0, kMarginPx, panels[i].caption, 1, kInk);
    drawPanel(canvas, x0, kMarginPx + kLinePx, panels[i], options);
  }
  drawText(canvas, kMarginPx, panels_bottom + 5,
           fmt::format("right: {}   down: {}", options.x_label, options.y_label), 1, kInk);
  drawColourBar(canvas, panels_bottom + kLinePx + kMarginPx, options);
  return canvas;
}

}  // namespace glintmark
