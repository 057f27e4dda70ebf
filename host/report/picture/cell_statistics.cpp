#include "host/report/picture/cell_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr std::size_t kMostBins = 16;
constexpr double kNumberColumns = 31, kLeastBarColumns = 5, kMostBarColumns = 50;
// Counts above this share the last entry, so that a wild count (the uncapped method can reach
// millions) does not take a huge table.
constexpr std::size_t kMostCounts = std::size_t{1} << 20;

}  // namespace

CellDistribution cellDistribution(const Image& cells) {
  if (cells.channels != 1) throw Error("a cell-count image has one channel");
  CellDistribution result;
  double sum = 0;
  for (const float count : cells.pixels) {
    if (!(count > 0)) continue;
    result.min = result.glint_px == 0 ? count : std::min<double>(result.min, count);
    result.max = std::max<double>(result.max, count);
    sum += count;
    ++result.glint_px;
    const auto bin = static_cast<std::size_t>(
        std::min(std::floor(static_cast<double>(count)), static_cast<double>(kMostCounts)));
    if (bin >= result.pixels_by_count.size()) result.pixels_by_count.resize(bin + 1);
    ++result.pixels_by_count[bin];
  }
  if (result.glint_px > 0) result.mean = sum / static_cast<double>(result.glint_px);
  return result;
}

std::string histogramText(const CellDistribution& distribution, std::size_t columns) {
  if (distribution.glint_px == 0) return "no pixel of the image visits a cell\n";
  const std::vector<std::size_t>& counts = distribution.pixels_by_count;
  const auto first = static_cast<std::size_t>(distribution.min);
  const std::size_t span = counts.size() - std::min(first, counts.size() - 1);
  const std::size_t bin_width = (span + kMostBins - 1) / kMostBins;

  std::vector<std::size_t> bins((span + bin_width - 1) / bin_width);
  for (std::size_t n = counts.size() - span; n < counts.size(); ++n) {
    bins[(n - (counts.size() - span)) / bin_width] += counts[n];
  }
  const auto fullest = static_cast<double>(std::ranges::max(bins));

  const double longest = std::clamp<double>(static_cast<double>(columns) - kNumberColumns,
                                            kLeastBarColumns, kMostBarColumns);
  std::string text = "     cells      pixels\n";
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    const std::size_t low = counts.size() - span + bin * bin_width;
    const std::size_t high = std::min(low + bin_width, counts.size()) - 1;
    const std::string range =
        low == high ? fmt::format("{}", low) : fmt::format("{}-{}", low, high);
    const auto pixels = static_cast<double>(bins[bin]);
    const auto bar = static_cast<std::size_t>(std::ceil(longest * pixels / fullest));
    text += fmt::format("{:>10} {:>11} {:>6.2f}% {}\n", range, bins[bin],
                        100 * pixels / static_cast<double>(distribution.glint_px),
                        std::string(bar, '#'));
  }
  return text;
}

}  // namespace glintmark
