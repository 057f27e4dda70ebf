// Numbers behind a heatmap: the distribution of cells per pixel.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// Distribution of a one-channel image of cell counts over the pixels that visited cells. Those at
/// 0 (a glint material that no light reaches) and below 0 (no glint material) do not take part.
struct CellDistribution {
  std::size_t glint_px = 0;
  double min = 0, mean = 0, max = 0;         // 0 if glint_px is 0
  std::vector<std::size_t> pixels_by_count;  // [n]: pixels that visited n cells, up to max
};
CellDistribution cellDistribution(const Image& cells);

/// The distribution as lines of text of at most `columns`, 36 or more: bins of whole counts with
/// pixel counts, percentages and bars, of 50 columns at most. Says so if there are no glint pixels.
std::string histogramText(const CellDistribution& distribution, std::size_t columns = 100);

}  // namespace glintmark
