// Line charts as display images, several small ones beside each other.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/report/picture/colour_map.h"

namespace glintmark {

struct ChartSeries {
  std::string name;
  DisplayColour colour{0, 0, 0};
  std::vector<double> x, y;  // of one length; points that are not finite are left out
  bool dots = false;         // points apart from each other, not a line
};

struct ChartPanel {
  std::string title;
  std::vector<ChartSeries> series;
  double x_low = 0, x_high = 1;
};

/// How numbers are placed. A logarithmic axis begins above 0.
enum class ChartScale { kLinear, kLogarithmic };

struct ChartOptions {
  int columns = 2;
  int panel_width_px = 320, panel_height_px = 220;
  ChartScale scale = ChartScale::kLinear;  // of both axes
  // Of every panel; 0: from 0, or on a logarithmic axis from each panel's own least value, to its
  // own greatest value.
  double y_low = 0, y_high = 0;
  std::string x_label{}, y_label{};
};

/// Colours of series that are told apart also by colour-blind eyes, after Okabe and Ito.
DisplayColour seriesColour(int index);

/// Panels in rows, each with axes; a legend of the first panel's series below. Throws Error for a
/// series whose x and y differ in length, no panel, or an empty range.
Image lineChart(const std::vector<ChartPanel>& panels, const ChartOptions& options);
/// The same as an SVG document.
std::string lineChartSvg(const std::vector<ChartPanel>& panels, const ChartOptions& options);

/// A chart of a run: FILE.png and FILE.svg of its folder, `file` without extension. Throws Error
/// like lineChart, or naming the file that cannot be written.
void writeChart(const std::vector<ChartPanel>& panels, const ChartOptions& options,
                const std::filesystem::path& file);

}  // namespace glintmark
