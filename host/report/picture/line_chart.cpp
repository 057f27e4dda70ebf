#include "host/report/picture/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/error.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr DisplayColour kPaper = {1, 1, 1}, kInk = {0.1f, 0.1f, 0.1f},
                        kGrid = {0.88f, 0.88f, 0.88f};
constexpr int kLeft_px = 44, kTop_px = 20, kRight_px = 12, kBottom_px = 22;
constexpr int kLine_px = kGlyphHeightPx + 6;
constexpr int kTicks = 4;  // intervals on an axis

// Where a panel's data go.
struct Plot {
  int left, top, width, height;
  double x_low, x_high, y_high;

  double column(double x) const { return left + (x - x_low) / (x_high - x_low) * width; }
  double row(double y) const { return top + (1 - y / y_high) * height; }
  bool holds(double x, double y) const {
    return std::isfinite(x) && std::isfinite(y) && x >= x_low && x <= x_high;
  }
};

void drawLine(Image& image, const Plot& plot, double x0, double y0, double x1, double y1,
              const DisplayColour& colour) {
  const int steps = 2 + static_cast<int>(2 * std::max(std::abs(x1 - x0), std::abs(y1 - y0)));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const int x = static_cast<int>(std::lround(x0 + t * (x1 - x0)));
    const int y = static_cast<int>(std::lround(y0 + t * (y1 - y0)));
    if (y >= plot.top - 1 && y <= plot.top + plot.height) fillRect(image, x, y, 2, 2, colour);
  }
}

void drawSeries(Image& image, const Plot& plot, const ChartSeries& series) {
  if (series.x.size() != series.y.size())
    throw Error(fmt::format("the series '{}' has {} abscissae and {} values", series.name,
                            series.x.size(), series.y.size()));
  bool joined = false;  // the point before this one is drawn
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!plot.holds(series.x[i], series.y[i])) {
      joined = false;
      continue;
    }
    const double x = plot.column(series.x[i]), y = plot.row(series.y[i]);
    if (series.dots) {
      if (y >= plot.top)
        fillRect(image, static_cast<int>(x) - 2, static_cast<int>(y) - 2, 5, 5, series.colour);
    } else if (joined) {
      drawLine(image, plot, plot.column(series.x[i - 1]), plot.row(series.y[i - 1]), x, y,
               series.colour);
    }
    joined = true;
  }
}

std::string tickLabel(double value) {
  return value == 0 ? "0" : fmt::format("{:.2g}", value);
}

void drawAxes(Image& image, const Plot& plot) {
  for (int tick = 0; tick <= kTicks; ++tick) {
    const double t = static_cast<double>(tick) / kTicks;
    const int y = plot.top + static_cast<int>((1 - t) * plot.height);
    fillRect(image, plot.left, y, plot.width, 1, tick == 0 ? kInk : kGrid);
    const std::string value = tickLabel(t * plot.y_high);
    drawText(image, plot.left - 4 - textWidth(value, 1), y - kGlyphHeightPx / 2, value, 1, kInk);
    const int x = plot.left + static_cast<int>(t * plot.width);
    fillRect(image, x, plot.top, 1, plot.height, tick == 0 ? kInk : kGrid);
    const std::string at = tickLabel(plot.x_low + t * (plot.x_high - plot.x_low));
    drawText(image, x - textWidth(at, 1) / 2, plot.top + plot.height + 5, at, 1, kInk);
  }
}

double greatestOf(const ChartPanel& panel) {
  double most = 0;
  for (const ChartSeries& series : panel.series)
    for (const double y : series.y)
      if (std::isfinite(y)) most = std::max(most, y);
  if (most <= 0) return 1;
  // The least number of two digits or fewer that four round steps make up.
  const double decade = std::pow(10, std::floor(std::log10(most / kTicks)));
  for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (kTicks * step * decade >= most) return kTicks * step * decade;
  return kTicks * 10 * decade;
}

void drawLegend(Image& image, int y, const ChartPanel& panel, const ChartOptions& options) {
  drawText(image, kLeft_px, y, fmt::format("right: {}   up: {}", options.x_label, options.y_label),
           1, kInk);
  int x = kLeft_px;
  for (const ChartSeries& series : panel.series) {
    const int width = 22 + textWidth(series.name, 1) + 16;
    if (x + width > image.width && x > kLeft_px) x = kLeft_px, y += kLine_px;
    fillRect(image, x, y + kLine_px + 2, 16, 3, series.colour);
    drawText(image, x + 22, y + kLine_px, series.name, 1, kInk);
    x += width;
  }
}

}  // namespace

DisplayColour seriesColour(int index) {
  constexpr std::array<DisplayColour, 6> kColours = {{{0, 0, 0},
                                                      {0.84f, 0.37f, 0},
                                                      {0, 0.45f, 0.70f},
                                                      {0, 0.62f, 0.45f},
                                                      {0.80f, 0.47f, 0.65f},
                                                      {0.90f, 0.62f, 0}}};
  return kColours[static_cast<std::size_t>(index) % kColours.size()];
}

Image lineChart(const std::vector<ChartPanel>& panels, const ChartOptions& options) {
  if (panels.empty() || options.columns < 1) throw Error("a chart needs a panel and a column");
  const int count = static_cast<int>(panels.size());
  const int columns = std::min(options.columns, count), rows = (count + columns - 1) / columns;
  Image image(columns * options.panel_width_px, rows * options.panel_height_px + 4 * kLine_px, 3);
  fillRect(image, 0, 0, image.width, image.height, kPaper);
  for (int i = 0; i < count; ++i) {
    const ChartPanel& panel = panels[static_cast<std::size_t>(i)];
    if (!(panel.x_high > panel.x_low))
      throw Error(fmt::format("the panel '{}' has an empty range", panel.title));
    const int x0 = i % columns * options.panel_width_px;
    const int y0 = i / columns * options.panel_height_px;
    const Plot plot = {x0 + kLeft_px,
                       y0 + kTop_px,
                       options.panel_width_px - kLeft_px - kRight_px,
                       options.panel_height_px - kTop_px - kBottom_px,
                       panel.x_low,
                       panel.x_high,
                       options.y_high > 0 ? options.y_high : greatestOf(panel)};
    drawText(image, plot.left, y0 + 6, panel.title, 1, kInk);
    drawAxes(image, plot);
    for (const ChartSeries& series : panel.series) drawSeries(image, plot, series);
  }
  drawLegend(image, rows * options.panel_height_px + 4, panels.front(), options);
  return image;
}

}  // namespace glintmark
