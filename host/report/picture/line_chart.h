// Line charts as display images, several small ones beside each other.
#pragma once
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

struct ChartOptions {
  int columns = 2;
  int panel_width_px = 320, panel_height_px = 220;
  double y_high = 0;  // of every panel, from 0; 0: each panel's own greatest value
  std::string x_label{}, y_label{};
};

/// Colours of series that are told apart also by colour-blind eyes, after Okabe and Ito.
DisplayColour seriesColour(int index);

/// Panels in rows, each with axes; a legend of the first panel's series below. Throws Error for a
/// series whose x and y differ in length, no panel, or an empty range.
Image lineChart(const std::vector<ChartPanel>& panels, const ChartOptions& options);

}  // namespace glintmark
