#include "host/simulate/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/ocl/upload.h"
#include "host/simulate/heightfield_types.h"
#include "host/simulate/surface_spectrum.h"

namespace glintmark {
namespace {

constexpr std::size_t kLocalSize = 16;
// Counts reach this many standard deviations; a tile has about 7000 independent heights.
constexpr double kMostDeviations = 6;

// A function of 2 pi i x / HF_TILE for every wave number i and texel x.
std::vector<float> waveTable(double (*function)(double)) {
  std::vector<float> table(std::size_t{HF_MODES} * HF_TILE);
  for (std::size_t i = 0; i < HF_MODES; ++i)
    for (std::size_t x = 0; x < HF_TILE; ++x)
      table[i * HF_TILE + x] = static_cast<float>(
          function(2 * std::numbers::pi * static_cast<double>(i * x % HF_TILE) / HF_TILE));
  return table;
}

// For every octant the blocks that rays of it reach: dx, dy, one over the distance between the
// squares (0 for neighbours, which come first), unused.
std::vector<float> reachedBlocks() {
  std::vector<std::array<int, 2>> first;  // octant: dx >= dy >= 0
  for (int dx = 0; dx <= HF_CONE_REACH; ++dx)
    for (int dy = 0; dy <= std::min(dx + 1, HF_CONE_REACH); ++dy) first.push_back({dx, dy});
  const auto gap = [](const std::array<int, 2>& block) {
    return std::hypot(std::max(block[0] - 1, 0), std::max(block[1] - 1, 0));
  };
  std::stable_partition(first.begin(), first.end(),
                        [&](const auto& block) { return gap(block) == 0; });
  std::vector<float> table;
  for (unsigned octant = 0; octant < HF_OCTANTS; ++octant)
    for (const std::array<int, 2>& block : first) {
      const bool steep = (octant & 4) != 0;
      const int x = block[steep ? 1 : 0], y = block[steep ? 0 : 1];
      const double distance = gap(block);
      table.insert(table.end(), {static_cast<float>(octant & 1 ? -x : x),
                                 static_cast<float>(octant & 2 ? -y : y),
                                 distance > 0 ? static_cast<float>(1 / distance) : 0.0f, 0.0f});
    }
  return table;
}

}  // namespace

SurfaceMaker::SurfaceMaker(Device& device, ProgramCache& cache, double correlation_texels) {
  const SurfaceSpectrum spectrum = makeSurfaceSpectrum(correlation_texels);
  count_height_ = static_cast<float>(spectrum.height_deviation * kMostDeviations / HF_MOST_COUNTS);
  const Program program = cache.getWithOptions("scatter/height_surface.cl", "");
  draw_modes_ = program.kernel("drawModes");
  sum_columns_ = program.kernel("sumColumns");
  sum_rows_ = program.kernel("sumRows");
  pack_heights_ = program.kernel("packHeights");
  block_tops_ = program.kernel("blockTops");
  block_cones_ = program.kernel("blockCones");
  const auto table = [&](const std::vector<float>& values, const char* what) {
    return upload(device, values, BufferPurpose::kSimulation, what);
  };
  amplitudes_ = table(spectrum.amplitudes, "the surface's amplitudes");
  cosines_ = table(waveTable(std::cos), "the surface's waves");
  sines_ = table(waveTable(std::sin), "the surface's waves");
  const auto words = [&](std::size_t count, const char* what) {
    return Buffer(device, count * 4, BufferPurpose::kSimulation, what);
  };
  modes_ = words(std::size_t{2} * HF_MODES * HF_MODE_ROWS, "the surface's modes");
  columns_ = words(std::size_t{2} * HF_MODES * HF_TILE, "the surface's columns");
  counts_ = words(std::size_t{HF_TILE} * HF_TILE, "the surface's heights");
  heights_ = words(HF_HEIGHT_WORDS, "the surface's packed heights");
  tops_ = words(std::size_t{2} * HF_TOP_WORDS, "the surface's block tops");
  highest_ = words(2, "the surface's extremes");
  reached_ = table(reachedBlocks(), "blocks that an octant reaches");
  cones_ = words(std::size_t{2} * HF_OCTANTS * HF_CONE_WORDS, "the surface's cones");
}

double SurfaceMaker::draw(std::uint32_t seed, bool both_sides) {
  double ns = 0;
  const auto launch = [&](Kernel& kernel, std::vector<KernelArg> args, std::size_t items) {
    ns += kernel.launch(args, items, kLocalSize).wall_ns;
  };
  launch(draw_modes_, {amplitudes_, modes_, seed}, std::size_t{HF_MODES} * HF_MODE_ROWS);
  launch(sum_columns_, {modes_, cosines_, sines_, columns_}, std::size_t{HF_MODES} * HF_TILE / 16);
  launch(sum_rows_, {columns_, cosines_, sines_, counts_, count_height_},
         std::size_t{HF_TILE} * HF_TILE / 16);
  launch(pack_heights_, {counts_, heights_}, HF_HEIGHT_WORDS);
  const std::int32_t lowest[2] = {-HF_MOST_COUNTS, -HF_MOST_COUNTS};
  highest_.write(lowest, sizeof lowest);
  launch(block_tops_, {counts_, tops_, highest_}, HF_TOP_WORDS);
  launch(block_cones_, {tops_, highest_, reached_, cones_},
         std::size_t{both_sides ? 2u : 1u} * HF_OCTANTS * HF_CONE_WORDS / 16);
  return ns;
}

std::vector<std::int32_t> SurfaceMaker::readCounts() const {
  std::vector<std::int32_t> counts(std::size_t{HF_TILE} * HF_TILE);
  counts_.read(counts.data(), counts.size() * 4);
  return counts;
}

SlopeMoments slopeMoments(const std::vector<std::int32_t>& counts, double count_height) {
  const auto height = [&](std::size_t x, std::size_t y) {
    return count_height * counts[y % HF_TILE * HF_TILE + x % HF_TILE];
  };
  SlopeMoments m;
  double fourth = 0;
  const auto add = [&](double sx, double sy) {
    m.variance_x += sx * sx;
    m.variance_y += sy * sy;
    m.covariance += sx * sy;
    fourth += sx * sx * sx * sx;
  };
  for (std::size_t y = 0; y < HF_TILE; ++y)
    for (std::size_t x = 0; x < HF_TILE; ++x) {
      const double h00 = height(x, y), h10 = height(x + 1, y);
      const double h01 = height(x, y + 1), h11 = height(x + 1, y + 1);
      add(h10 - h00, h11 - h10);
      add(h11 - h01, h01 - h00);
    }
  const double facets = 2.0 * HF_TILE * HF_TILE;
  m.variance_x /= facets;
  m.variance_y /= facets;
  m.covariance /= facets;
  m.kurtosis_x = fourth / facets / (m.variance_x * m.variance_x);
  return m;
}

}  // namespace glintmark
