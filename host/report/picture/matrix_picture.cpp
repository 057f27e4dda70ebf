#include "host/report/picture/matrix_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/report/picture/colour_scale.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr int kMatrixIntervals = 5;  // on the colour bar

// Sizes in pixels for text of one size.
struct Layout {
  int text, margin, left, top;  // of the first panel
  int panel_width, panel_height, x_label, title, bar, width, height;

  Layout(int panels, const MatrixPictureOptions& options)
      : panel_width(options.width * options.entry_px),
        panel_height(options.height * options.entry_px) {
    text = textSizeFor(panels * panel_width);
    margin = text * 3 / 2;
    left = margin + (options.y_label.empty() ? 0 : text * 3 / 2);
    top = margin + text * 3 / 2;
    x_label = top + panel_height + text * 3 / 2;
    title = x_label + text * 9 / 4;
    bar = title + text * 3 / 4;
    width = left + panels * (panel_width + margin);
    height = bar + colourScaleHeight(text) + margin;
  }
};

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

}  // namespace

Image matrixPicture(const std::vector<MatrixPanel>& panels, const MatrixPictureOptions& options) {
  const int count = static_cast<int>(panels.size());
  for (const MatrixPanel& panel : panels) {
    if (panel.values.size() != static_cast<std::size_t>(options.width) * options.height) {
      throw Error(fmt::format("the panel '{}' has {} values, expected {} x {}", panel.caption,
                              panel.values.size(), options.width, options.height));
    }
  }
  const Layout layout(count, options);
  const TextStyle bold{.size_px = layout.text, .weight = TextWeight::kBold};
  const TextStyle soft{.size_px = layout.text, .colour = kSoftInk};
  Image canvas(layout.width, layout.height, 3);
  fillRect(canvas, 0, 0, canvas.width, canvas.height, kPaper);
  for (int i = 0; i < count; ++i) {
    const int x0 = layout.left + i * (layout.panel_width + layout.margin);
    const std::string& caption = panels[static_cast<std::size_t>(i)].caption;
    drawText(canvas, x0, layout.top - layout.text / 2, caption,
             fitted(bold, caption, layout.panel_width));
    drawPanel(canvas, x0, layout.top, panels[static_cast<std::size_t>(i)], options);
    drawText(canvas, x0, layout.x_label, options.x_label,
             fitted(soft, options.x_label, layout.panel_width));
  }
  // Reads in the direction in which its values grow.
  drawTurnedText(canvas, layout.left - layout.text, layout.top + layout.panel_height / 2,
                 options.y_label, fitted(soft, options.y_label, layout.panel_height),
                 TextTurn::kDownwards);
  const int bar_width = canvas.width - layout.left - layout.margin;
  drawText(canvas, layout.left, layout.title, options.title,
           fitted(bold, options.title, bar_width));
  drawColourScale(
      canvas, layout.left, layout.bar, bar_width,
      {.low = options.low, .high = options.high, .intervals = kMatrixIntervals, .decimals = 2},
      layout.text);
  return canvas;
}

}  // namespace glintmark
