#include "host/report/picture/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/error.h"
#include "host/report/picture/shape_drawing.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr int kTitle_px = 13, kText_px = 12;
constexpr int kLeft_px = 46, kTop_px = 30, kRight_px = 16, kBottom_px = 24;
constexpr int kLine_px = 20;         // of the legend
constexpr int kLabelColumn_px = 22;  // left of all panels, for the label of their ordinates
constexpr int kSwatch_px = 18;
constexpr double kLineWidth_px = 2, kDotRadius_px = 2.6;
constexpr int kTicks = 4;  // intervals on an axis

constexpr TextStyle kTickStyle{.size_px = kText_px, .colour = kSoftInk};
constexpr TextStyle kLegendStyle{.size_px = kTitle_px};

// Where a panel's data go.
struct Plot {
  int left, top, width, height;
  double x_low, x_high, y_high;

  double column(double x) const { return left + (x - x_low) / (x_high - x_low) * width; }
  double row(double y) const { return top + (1 - y / y_high) * height; }
  glm::dvec2 point(double x, double y) const { return {column(x), row(y)}; }
  // Lines may stand over by half their width.
  ClipBox clip() const { return {left - 2, top - 2, left + width + 3, top + height + 3}; }
  bool holds(double x, double y) const {
    return std::isfinite(x) && std::isfinite(y) && x >= x_low && x <= x_high;
  }
};

void drawSeries(Image& image, const Plot& plot, const ChartSeries& series) {
  if (series.x.size() != series.y.size())
    throw Error(fmt::format("the series '{}' has {} abscissae and {} values", series.name,
                            series.x.size(), series.y.size()));
  std::vector<glm::dvec2> line;  // points that no gap parts
  const auto draw_part = [&] {
    if (line.size() > 1) drawPolyline(image, line, kLineWidth_px, series.colour, plot.clip());
    line.clear();
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!plot.holds(series.x[i], series.y[i])) {
      draw_part();
      continue;
    }
    const glm::dvec2 point = plot.point(series.x[i], series.y[i]);
    if (!series.dots)
      line.push_back(point);
    else if (point.y >= plot.top)
      drawDot(image, point, kDotRadius_px, series.colour, plot.clip());
  }
  draw_part();
}

std::string tickLabel(double value) {
  return value == 0 ? "0" : fmt::format("{:.2g}", value);
}

void drawAxes(Image& image, const Plot& plot) {
  const int bottom = plot.top + plot.height;
  for (int tick = 0; tick <= kTicks; ++tick) {
    const double t = static_cast<double>(tick) / kTicks;
    const int y = plot.top + static_cast<int>((1 - t) * plot.height);
    fillRect(image, plot.left, y, plot.width + 1, 1, tick == 0 ? kSoftInk : kGridInk);
    drawText(image, plot.left - 8, y + kText_px / 3, tickLabel(t * plot.y_high), kTickStyle,
             TextAlign::kRight);
    const int x = plot.left + static_cast<int>(t * plot.width);
    fillRect(image, x, bottom, 1, 5, kSoftInk);
    drawText(image, x, bottom + 7 + kText_px * 3 / 4,
             tickLabel(plot.x_low + t * (plot.x_high - plot.x_low)), kTickStyle,
             TextAlign::kCentre);
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

// Rows of the legend: each its series.
std::vector<std::vector<const ChartSeries*>> legendRows(const ChartPanel& panel, int width_px) {
  std::vector<std::vector<const ChartSeries*>> rows(1);
  int used = 0;
  for (const ChartSeries& series : panel.series) {
    const int width = kSwatch_px + 6 + textWidth(series.name, kLegendStyle) + 20;
    if (used + width > width_px && used > 0) {
      rows.emplace_back();
      used = 0;
    }
    rows.back().push_back(&series);
    used += width;
  }
  return rows;
}

void drawLineLegend(Image& image, int x0, int y,
                    const std::vector<std::vector<const ChartSeries*>>& rows) {
  const ClipBox all = {0, 0, image.width, image.height};
  for (const auto& row : rows) {
    int x = x0;
    for (const ChartSeries* series : row) {
      const double middle = y - kTitle_px * 0.33;
      const glm::dvec2 ends[] = {{x + 1, middle}, {x + kSwatch_px - 1, middle}};
      if (series->dots)
        drawDot(image, (ends[0] + ends[1]) / 2.0, kDotRadius_px, series->colour, all);
      else
        drawPolyline(image, ends, kLineWidth_px + 0.5, series->colour, all);
      drawText(image, x + kSwatch_px + 6, y, series->name, kLegendStyle);
      x += kSwatch_px + 6 + textWidth(series->name, kLegendStyle) + 20;
    }
    y += kLine_px;
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
  const int panels_left = options.y_label.empty() ? 0 : kLabelColumn_px;
  const int width = panels_left + columns * options.panel_width_px;
  const int panels_bottom = rows * options.panel_height_px;
  const int label_height = options.x_label.empty() ? 0 : kLine_px;
  const int legend_left = panels_left + kLeft_px;
  const auto legend = legendRows(panels.front(), width - legend_left - kRight_px);
  Image image(width,
              panels_bottom + label_height + kLine_px * static_cast<int>(legend.size()) + kLine_px,
              3);
  fillRect(image, 0, 0, image.width, image.height, kPaper);
  for (int i = 0; i < count; ++i) {
    const ChartPanel& panel = panels[static_cast<std::size_t>(i)];
    if (!(panel.x_high > panel.x_low))
      throw Error(fmt::format("the panel '{}' has an empty range", panel.title));
    const int x0 = panels_left + i % columns * options.panel_width_px;
    const int y0 = i / columns * options.panel_height_px;
    const Plot plot = {x0 + kLeft_px,
                       y0 + kTop_px,
                       options.panel_width_px - kLeft_px - kRight_px,
                       options.panel_height_px - kTop_px - kBottom_px,
                       panel.x_low,
                       panel.x_high,
                       options.y_high > 0 ? options.y_high : greatestOf(panel)};
    const TextStyle bold{.size_px = kTitle_px, .weight = TextWeight::kBold};
    drawText(image, plot.left, plot.top - 11, panel.title, fitted(bold, panel.title, plot.width));
    drawAxes(image, plot);
    for (const ChartSeries& series : panel.series) drawSeries(image, plot, series);
  }
  drawTurnedText(image, kLabelColumn_px / 2 + 2, panels_bottom / 2, options.y_label,
                 fitted(kLegendStyle, options.y_label, panels_bottom), TextTurn::kUpwards);
  drawText(image, (legend_left + width - kRight_px) / 2, panels_bottom + kText_px, options.x_label,
           fitted(kLegendStyle, options.x_label, width - legend_left - kRight_px),
           TextAlign::kCentre);
  drawLineLegend(image, legend_left, panels_bottom + label_height + kLine_px, legend);
  return image;
}

}  // namespace glintmark
