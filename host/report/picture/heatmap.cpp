#include "host/report/picture/heatmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "host/core/error.h"
#include "host/report/picture/colour_scale.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr std::string_view kFilePrefix = "cells_";

constexpr DisplayColour kUncovered = {0.16f, 0.16f, 0.16f};
constexpr DisplayColour kUnlit = {0.35f, 0.35f, 0.35f};
constexpr int kCellIntervals = 8;  // on the colour bar: 8, 15, 22, ... 64 on the fixed scale

constexpr int kLegendMinWidth = 320;

// Where the parts of a legend are, in pixels below its top edge, for text of one size.
struct LegendLayout {
  int text, title_size, margin;
  int title, statistics, bar, height;

  explicit LegendLayout(int width_px)
      : text(textSizeFor(width_px)),
        title_size(text * 5 / 4),
        margin(text),
        title(text / 2 + title_size),
        statistics(title + text * 3 / 2),
        bar(statistics + text * 4 / 5),
        height(bar + colourScaleHeight(text) + text * 4 / 5) {}
};

// A display colour as a PNG stores it.
std::uint32_t packed(std::span<const float> colour) {
  std::uint32_t bytes = 0;
  for (int c = 0; c < 3; ++c)
    bytes = bytes << 8 | static_cast<std::uint32_t>(std::lround(255 * colour[c]));
  return bytes;
}

Image blankCanvas(int width, int height) {
  Image canvas(width, height, 3);
  fillRect(canvas, 0, 0, width, height, kPaper);
  return canvas;
}

void paste(const Image& source, Image& target, int x0, int y0) {
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; ++x) {
      std::ranges::copy(source.at(x, y), target.at(x0 + x, y0 + y).begin());
    }
  }
}

// Greys say why a pixel has no count; named are those that the picture has.
struct Grey {
  const char* name;
  DisplayColour colour;
  bool present = false;
};
using Greys = std::array<Grey, 2>;

Greys greysOf(const std::vector<const Image*>& pictures) {
  Greys greys = {{{"unlit", kUnlit}, {"no glints", kUncovered}}};
  for (const Image* cells : pictures)
    for (const float count : cells->pixels) {
      greys[0].present |= count == 0;
      greys[1].present |= count < 0;
    }
  return greys;
}

// From right to left, up to `x`; where there is no room for it, a grey stays unnamed.
void drawGreys(Image& canvas, int first_x, int baseline_y, const Greys& greys, int size_px) {
  const TextStyle style{.size_px = size_px, .colour = kSoftInk};
  const int side = size_px * 3 / 4, gap = size_px / 2;
  int x = canvas.width - size_px;
  for (const Grey& grey : greys) {
    if (!grey.present) continue;
    const int width = side + gap + textWidth(grey.name, style);
    if (x - width < first_x) return;
    drawText(canvas, x, baseline_y, grey.name, style, TextAlign::kRight);
    x -= width;
    fillRect(canvas, x, baseline_y - side, side, side, grey.colour);
    x -= 2 * gap;
  }
}

// Title, statistics, greys and the colour bar; its top edge at y.
void drawHeatLegend(Image& canvas, int y, const HeatmapRange& range, const std::string& title,
                    const std::string& statistics, const Greys& greys) {
  const LegendLayout layout(canvas.width);
  const int width = canvas.width - 2 * layout.margin;
  const TextStyle bold{.size_px = layout.title_size, .weight = TextWeight::kBold};
  drawText(canvas, layout.margin, y + layout.title, title, fitted(bold, title, width));
  const TextStyle soft = fitted({.size_px = layout.text, .colour = kSoftInk}, statistics, width);
  drawText(canvas, layout.margin, y + layout.statistics, statistics, soft);
  drawGreys(canvas, layout.margin + textWidth(statistics, soft) + layout.text,
            y + layout.statistics, greys, layout.text);
  drawColourScale(canvas, layout.margin, y + layout.bar, width,
                  {.low = range.low, .high = range.high, .intervals = kCellIntervals}, layout.text);
}

std::string statisticsText(const CellDistribution& distribution, std::size_t guard_hits) {
  if (distribution.glint_px == 0) return "no glint pixels";
  return fmt::format("min {:.0f}    mean {:.2f}    max {:.0f}    guard hits {}", distribution.min,
                     distribution.mean, distribution.max, guard_hits);
}

}  // namespace

HeatmapRange heatmapRange(HeatmapScale scale, const CellDistribution& distribution) {
  if (scale == HeatmapScale::kFixed) return {};
  return {distribution.min, std::max(distribution.max, distribution.min + 1)};
}

Image heatmapColours(const Image& cells, const HeatmapRange& range) {
  if (cells.channels != 1) throw Error("a cell-count image has one channel");
  Image colours(cells.width, cells.height, 3);
  const double span = range.high - range.low;
  for (int y = 0; y < cells.height; ++y) {
    for (int x = 0; x < cells.width; ++x) {
      const float count = cells.at(x, y)[0];
      const DisplayColour colour = count > 0    ? falseColour((count - range.low) / span)
                                   : count == 0 ? kUnlit
                                                : kUncovered;
      std::ranges::copy(colour, colours.at(x, y).begin());
    }
  }
  return colours;
}

Image heatmapPicture(const Image& cells, const HeatmapOptions& options) {
  const CellDistribution distribution = cellDistribution(cells);
  const HeatmapRange range = heatmapRange(options.scale, distribution);
  const int width = std::max(cells.width, kLegendMinWidth);
  Image canvas = blankCanvas(width, cells.height + LegendLayout(width).height);
  paste(heatmapColours(cells, range), canvas, 0, 0);
  drawHeatLegend(canvas, cells.height, range, options.title,
                 statisticsText(distribution, options.guard_hits), greysOf({&cells}));
  return canvas;
}

CellDistribution heatmapDistribution(const Image& picture) {
  if (picture.channels < 3) throw Error("a heatmap has three channels");
  const HeatmapRange range;
  std::unordered_map<std::uint32_t, float> counts;
  for (double n = range.low; n <= range.high; ++n)
    counts[packed(falseColour((n - range.low) / (range.high - range.low)))] = static_cast<float>(n);
  // The counts fill the first column down to the paper of the legend, however that is laid out.
  int height = 0;
  while (height < picture.height && packed(picture.at(0, height)) != packed(kPaper)) ++height;
  Image cells(picture.width, height, 1);
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      const auto found = counts.find(packed(picture.at(x, y)));
      cells.at(x, y)[0] = found == counts.end() ? -1.0f : found->second;
    }
  return cellDistribution(cells);
}

std::string heatmapFile(const CaseName& name) {
  return std::string(kFilePrefix) + name.fileStem() + ".png";
}

bool isHeatmapFile(std::string_view name) {
  return name.starts_with(kFilePrefix);
}

Image heatmapStrip(const std::vector<Image>& cells, const std::vector<std::string>& captions,
                   HeatmapScale scale, const std::string& title) {
  if (cells.empty() || cells.size() != captions.size()) {
    throw Error("a heatmap strip needs one caption for each of at least one picture");
  }
  CellDistribution all = cellDistribution(cells.front());
  int images_width = 0, images_height = 0;
  for (const Image& image : cells) {
    const CellDistribution one = cellDistribution(image);
    all.min = std::min(all.min, one.min);
    all.max = std::max(all.max, one.max);
    images_width += image.width;
    images_height = std::max(images_height, image.height);
  }
  const HeatmapRange range = heatmapRange(scale, all);
  const int width = std::max(images_width, kLegendMinWidth);
  const LegendLayout layout(width);
  const int captions_height = layout.text * 7 / 4;
  Image canvas = blankCanvas(width, images_height + captions_height + layout.height);
  int x = 0;
  std::vector<const Image*> pictures;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    paste(heatmapColours(cells[i], range), canvas, x, 0);
    const TextStyle style = fitted({.size_px = layout.text}, captions[i], cells[i].width);
    drawText(canvas, x + cells[i].width / 2, images_height + layout.text * 5 / 4, captions[i],
             style, TextAlign::kCentre);
    x += cells[i].width;
    pictures.push_back(&cells[i]);
  }
  drawHeatLegend(canvas, images_height + captions_height, range, title,
                 fmt::format("min {:.0f}    max {:.0f}", all.min, all.max), greysOf(pictures));
  return canvas;
}

}  // namespace glintmark
