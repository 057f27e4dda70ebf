// False-colour pictures of cells visited per pixel, after [ZK16] Fig. 9.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/image.h"
#include "host/report/picture/cell_statistics.h"
#include "host/report/record/case_name.h"

namespace glintmark {

enum class HeatmapScale {
  kFixed,  // 8 to 64 cells, the paper's range [ZK16] Sect. 5; counts outside take the end colours
  kAuto,   // smallest to largest count of the image
};

struct HeatmapOptions {
  HeatmapScale scale = HeatmapScale::kFixed;
  std::string title;           // drawn above the colour bar
  std::size_t guard_hits = 0;  // printed beside it
};

/// Range of counts that the colour bar covers, low < high.
struct HeatmapRange {
  double low = 8, high = 64;
};
HeatmapRange heatmapRange(HeatmapScale scale, const CellDistribution& distribution);

/// The display colours of the counts alone, without legend, as RGB in [0, 1]. Pixels below 0 (no
/// glint material) are dark grey, those at 0 (no light reaches them) a lighter grey.
Image heatmapColours(const Image& cells, const HeatmapRange& range);

/// The whole picture: the counts, below them title, statistics, and colour bar with ticks. The
/// image keeps its size at the top left; the canvas is at least wide enough for the legend.
Image heatmapPicture(const Image& cells, const HeatmapOptions& options);

/// The distribution behind a heatmapPicture of kFixed scale, read back from its colours; counts
/// outside 8 to 64 come back as the nearer end.
CellDistribution heatmapDistribution(const Image& picture);

/// The heatmap of a case in a folder of results: "cells_snow_steep.png" of "snow/steep".
std::string heatmapFile(const CaseName& name);
/// Is a file named like one?
bool isHeatmapFile(std::string_view name);

/// Pictures of one view each side by side with a caption under each, one legend below.
Image heatmapStrip(const std::vector<Image>& cells, const std::vector<std::string>& captions,
                   HeatmapScale scale, const std::string& title);

}  // namespace glintmark
