#include "host/report/picture/heatmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "host/core/error.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr std::string_view kFilePrefix = "cells_";

constexpr DisplayColour kUncovered = {0.16f, 0.16f, 0.16f};
constexpr DisplayColour kUnlit = {0.35f, 0.35f, 0.35f};
constexpr DisplayColour kPaper = {1, 1, 1};
constexpr DisplayColour kInk = {0, 0, 0};
constexpr int kTicks = 8;  // intervals on the colour bar: 8, 15, 22, ... 64 on the fixed scale

// Sizes in pixels at text scale 1; everything grows with the text.
constexpr int kMargin = 4;
constexpr int kLine = kGlyphHeightPx + 4;
constexpr int kBarHeight = 10;
constexpr int kTickHeight = 3;
constexpr int kLegendHeight = kMargin + 2 * kLine + kBarHeight + kTickHeight + 2 + kLine;
constexpr int kLegendMinWidth = 320;

// A display colour as a PNG stores it.
std::uint32_t packed(std::span<const float> colour) {
  std::uint32_t bytes = 0;
  for (int c = 0; c < 3; ++c)
    bytes = bytes << 8 | static_cast<std::uint32_t>(std::lround(255 * colour[c]));
  return bytes;
}

int textScale(int width_px) {
  return std::clamp(width_px / 640, 1, 3);
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

std::string tickLabel(double value) {
  return value == std::floor(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.1f}", value);
}

// Two lines of text, the colour bar, ticks with labels; its top edge at y.
void drawLegend(Image& canvas, int y, const HeatmapRange& range, const std::string& title,
                const std::string& statistics) {
  const int scale = textScale(canvas.width), margin = kMargin * scale;
  const int width = canvas.width - 2 * margin;
  y += margin;
  drawText(canvas, margin, y, title, scale, kInk);
  y += kLine * scale;
  drawText(canvas, margin, y, statistics, scale, kInk);
  y += kLine * scale;
  for (int x = 0; x < width; ++x) {
    fillRect(canvas, margin + x, y, 1, kBarHeight * scale, falseColour(x / (width - 1.0)));
  }
  y += kBarHeight * scale;
  for (int tick = 0; tick <= kTicks; ++tick) {
    const double t = static_cast<double>(tick) / kTicks;
    const int x = margin + static_cast<int>(std::lround(t * (width - scale)));
    fillRect(canvas, x, y, scale, kTickHeight * scale, kInk);
    const std::string label = tickLabel(std::lerp(range.low, range.high, t));
    const int label_width = textWidth(label, scale);
    const int label_x = std::clamp(x - label_width / 2, margin, margin + width - label_width);
    drawText(canvas, label_x, y + (kTickHeight + 2) * scale, label, scale, kInk);
  }
}

std::string statisticsText(const CellDistribution& distribution, std::size_t guard_hits) {
  if (distribution.glint_px == 0) return "no glint pixels";
  return fmt::format("min {:.0f}  mean {:.2f}  max {:.0f}  guard hits {}", distribution.min,
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
  Image canvas = blankCanvas(width, cells.height + kLegendHeight * textScale(width));
  paste(heatmapColours(cells, range), canvas, 0, 0);
  drawLegend(canvas, cells.height, range, options.title,
             statisticsText(distribution, options.guard_hits));
  return canvas;
}

CellDistribution heatmapDistribution(const Image& picture) {
  if (picture.channels < 3) throw Error("a heatmap has three channels");
  const HeatmapRange range;
  std::unordered_map<std::uint32_t, float> counts;
  for (double n = range.low; n <= range.high; ++n)
    counts[packed(falseColour((n - range.low) / (range.high - range.low)))] = static_cast<float>(n);
  const int height = picture.height - kLegendHeight * textScale(picture.width);
  Image cells(picture.width, std::max(height, 0), 1);
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
  const int width = std::max(images_width, kLegendMinWidth), text = textScale(width);
  const int captions_height = kLine * text;
  Image canvas = blankCanvas(width, images_height + captions_height + kLegendHeight * text);
  int x = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    paste(heatmapColours(cells[i], range), canvas, x, 0);
    const int caption_x = x + (cells[i].width - textWidth(captions[i], text)) / 2;
    drawText(canvas, caption_x, images_height + kMargin * text / 2, captions[i], text, kInk);
    x += cells[i].width;
  }
  drawLegend(canvas, images_height + captions_height, range, title,
             fmt::format("min {:.0f}  max {:.0f}", all.min, all.max));
  return canvas;
}

}  // namespace glintmark
