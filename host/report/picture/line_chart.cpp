#include "host/report/picture/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/report/picture/chart_canvas.h"
#include "host/report/picture/image_io.h"

namespace glintmark {
namespace {

constexpr int kTitle_px = 13, kText_px = 12;
constexpr int kLeft_px = 46, kTop_px = 30, kRight_px = 16, kBottom_px = 24;
constexpr int kLine_px = 20;         // of the legend
constexpr int kLabelColumn_px = 22;  // left of all panels, for the label of their ordinates
constexpr int kSwatch_px = 18;
constexpr double kLineWidth_px = 2, kDotRadius_px = 2.6;
constexpr int kTicks = 4;                // intervals on a linear axis
constexpr double kLogMargin = 1.3;       // around the data of a logarithmic one
constexpr double kAlmostOne = 1 - 1e-9;  // ends that fall on a tick have it
constexpr double kRounding = 1e-6;       // the same of pixels

constexpr TextStyle kTickStyle{.size_px = kText_px, .colour = kSoftInk};
constexpr TextStyle kLegendStyle{.size_px = kTitle_px};

// An axis: from 0 in even steps, or in decades.
struct Axis {
  double low = 0, high = 1;
  bool logarithmic = false;

  double share(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low)
                       : (value - low) / (high - low);
  }
  bool holds(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  std::vector<double> ticks() const;
};

// Four even steps; or 1, 2 and 5 of every decade, 1 alone where there are many.
std::vector<double> Axis::ticks() const {
  std::vector<double> values;
  if (!logarithmic) {
    for (int tick = 0; tick <= kTicks; ++tick) values.push_back(low + (high - low) * tick / kTicks);
    return values;
  }
  const bool decades_only = high / low > 300;
  for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0}) {
      const double value = step * decade;
      if (step > 1 && decades_only) continue;
      if (value >= low * kAlmostOne && value <= high / kAlmostOne) values.push_back(value);
    }
  return values;
}

// Where a panel's data go.
struct Plot {
  int left, top, width, height;
  Axis x, y;

  double column(double value) const { return left + x.share(value) * width; }
  double row(double value) const { return top + (1 - y.share(value)) * height; }
  glm::dvec2 point(double px, double py) const { return {column(px), row(py)}; }
  // Lines may stand over by half their width.
  ClipBox clip() const { return {left - 2, top - 2, left + width + 3, top + height + 3}; }
  bool holds(double px, double py) const {
    return x.holds(px) && y.holds(py) && px >= x.low && px <= x.high;
  }
};

void drawSeries(ChartCanvas& canvas, const Plot& plot, const ChartSeries& series) {
  if (series.x.size() != series.y.size())
    throw Error(fmt::format("the series '{}' has {} abscissae and {} values", series.name,
                            series.x.size(), series.y.size()));
  std::vector<glm::dvec2> line;  // points that no gap parts
  const auto draw_part = [&] {
    if (line.size() > 1) canvas.polyline(line, kLineWidth_px, series.colour, plot.clip());
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
      canvas.dot(point, kDotRadius_px, series.colour, plot.clip());
  }
  draw_part();
}

std::string tickLabel(double value) {
  if (value == 0) return "0";
  return value >= 100 && value < 1e5 ? fmt::format("{:.0f}", value) : fmt::format("{:.2g}", value);
}

void drawAxes(ChartCanvas& canvas, const Plot& plot) {
  const int bottom = plot.top + plot.height;
  canvas.fill(plot.left, bottom, plot.width + 1, 1, kSoftInk);
  for (const double value : plot.y.ticks()) {
    const int y = plot.top + static_cast<int>((1 - plot.y.share(value)) * plot.height + kRounding);
    if (y < bottom) canvas.fill(plot.left, y, plot.width + 1, 1, kGridInk);
    canvas.text(plot.left - 8, y + kText_px / 3, tickLabel(value), kTickStyle, TextAlign::kRight);
  }
  for (const double value : plot.x.ticks()) {
    const int x = plot.left + static_cast<int>(plot.x.share(value) * plot.width + kRounding);
    canvas.fill(x, bottom, 1, 5, kSoftInk);
    canvas.text(x, bottom + 7 + kText_px * 3 / 4, tickLabel(value), kTickStyle, TextAlign::kCentre);
  }
}

double roundedUp(double most) {
  if (most <= 0) return 1;
  // The least number of two digits or fewer that four round steps make up.
  const double decade = std::pow(10, std::floor(std::log10(most / kTicks)));
  for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (kTicks * step * decade >= most) return kTicks * step * decade;
  return kTicks * 10 * decade;
}

Axis ordinates(const ChartPanel& panel, const ChartOptions& options) {
  Axis axis{.logarithmic = options.scale == ChartScale::kLogarithmic};
  double least = std::numeric_limits<double>::max(), most = 0;
  for (const ChartSeries& series : panel.series)
    for (const double y : series.y)
      if (axis.holds(y)) least = std::min(least, y), most = std::max(most, y);
  if (!axis.logarithmic) {
    axis.high = options.y_high > 0 ? options.y_high : roundedUp(most);
    return axis;
  }
  if (most <= 0) least = most = 1;
  axis.low = options.y_low > 0 ? options.y_low : least / kLogMargin;
  axis.high = options.y_high > 0 ? options.y_high : most * kLogMargin;
  return axis;
}

Axis abscissae(const ChartPanel& panel, const ChartOptions& options) {
  const Axis axis{panel.x_low, panel.x_high, options.scale == ChartScale::kLogarithmic};
  if (!(axis.high > axis.low) || (axis.logarithmic && axis.low <= 0))
    throw Error(fmt::format("the panel '{}' has an empty range", panel.title));
  return axis;
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

void drawLineLegend(ChartCanvas& canvas, int x0, int y, const ClipBox& all,
                    const std::vector<std::vector<const ChartSeries*>>& rows) {
  for (const auto& row : rows) {
    int x = x0;
    for (const ChartSeries* series : row) {
      const double middle = y - kTitle_px * 0.33;
      const glm::dvec2 ends[] = {{x + 1, middle}, {x + kSwatch_px - 1, middle}};
      if (series->dots)
        canvas.dot((ends[0] + ends[1]) / 2.0, kDotRadius_px, series->colour, all);
      else
        canvas.polyline(ends, kLineWidth_px + 0.5, series->colour, all);
      canvas.text(x + kSwatch_px + 6, y, series->name, kLegendStyle, TextAlign::kLeft);
      x += kSwatch_px + 6 + textWidth(series->name, kLegendStyle) + 20;
    }
    y += kLine_px;
  }
}

// Where panels and legend stand.
struct ChartLayout {
  int width = 0, height = 0, columns = 1, panels_left = 0, panels_bottom = 0, legend_top = 0;
  std::vector<std::vector<const ChartSeries*>> legend{};

  int legendLeft() const { return panels_left + kLeft_px; }
};

ChartLayout layOut(const std::vector<ChartPanel>& panels, const ChartOptions& options) {
  if (panels.empty() || options.columns < 1) throw Error("a chart needs a panel and a column");
  const int count = static_cast<int>(panels.size());
  ChartLayout layout;
  layout.columns = std::min(options.columns, count);
  layout.panels_left = options.y_label.empty() ? 0 : kLabelColumn_px;
  layout.width = layout.panels_left + layout.columns * options.panel_width_px;
  layout.panels_bottom = (count + layout.columns - 1) / layout.columns * options.panel_height_px;
  layout.legend = legendRows(panels.front(), layout.width - layout.legendLeft() - kRight_px);
  layout.legend_top = layout.panels_bottom + (options.x_label.empty() ? 0 : kLine_px) + kLine_px;
  layout.height = layout.legend_top + kLine_px * static_cast<int>(layout.legend.size());
  return layout;
}

void drawChartPanel(ChartCanvas& canvas, const ChartPanel& panel, const ChartOptions& options,
                    int x0, int y0) {
  const Plot plot = {x0 + kLeft_px,
                     y0 + kTop_px,
                     options.panel_width_px - kLeft_px - kRight_px,
                     options.panel_height_px - kTop_px - kBottom_px,
                     abscissae(panel, options),
                     ordinates(panel, options)};
  const TextStyle bold{.size_px = kTitle_px, .weight = TextWeight::kBold};
  canvas.text(plot.left, plot.top - 11, panel.title, fitted(bold, panel.title, plot.width),
              TextAlign::kLeft);
  drawAxes(canvas, plot);
  for (const ChartSeries& series : panel.series) drawSeries(canvas, plot, series);
}

void drawChart(ChartCanvas& canvas, const std::vector<ChartPanel>& panels,
               const ChartOptions& options, const ChartLayout& layout) {
  for (int i = 0; i < static_cast<int>(panels.size()); ++i)
    drawChartPanel(canvas, panels[static_cast<std::size_t>(i)], options,
                   layout.panels_left + i % layout.columns * options.panel_width_px,
                   i / layout.columns * options.panel_height_px);
  canvas.textUpwards(kLabelColumn_px / 2 + 2, layout.panels_bottom / 2, options.y_label,
                     fitted(kLegendStyle, options.y_label, layout.panels_bottom));
  const int right = layout.width - kRight_px;
  canvas.text((layout.legendLeft() + right) / 2, layout.panels_bottom + kText_px, options.x_label,
              fitted(kLegendStyle, options.x_label, right - layout.legendLeft()),
              TextAlign::kCentre);
  drawLineLegend(canvas, layout.legendLeft(), layout.legend_top,
                 {0, 0, layout.width, layout.height}, layout.legend);
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
  const ChartLayout layout = layOut(panels, options);
  PixelCanvas canvas(layout.width, layout.height);
  drawChart(canvas, panels, options, layout);
  return canvas.take();
}

std::string lineChartSvg(const std::vector<ChartPanel>& panels, const ChartOptions& options) {
  const ChartLayout layout = layOut(panels, options);
  SvgCanvas canvas(layout.width, layout.height);
  drawChart(canvas, panels, options, layout);
  return canvas.take();
}

void writeChart(const std::vector<ChartPanel>& panels, const ChartOptions& options,
                const std::filesystem::path& file) {
  writePng(lineChart(panels, options), file.string() + ".png");
  writeFile(file.string() + ".svg", lineChartSvg(panels, options));
}

}  // namespace glintmark
