#include "host/reference/lit_details.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/reference/binomial.h"

namespace glintmark::reference {
namespace {

constexpr double kFrom = 1, kDoublings = 2;           // reflecting microdetails in a pixel
constexpr double kLeastDetails = 2;                   // in a pixel
constexpr double kRareDoublings = 16;                 // of P(more reflect than there are) < (e p)^M
constexpr double kLength = 6, kMostLength = 8;        // half a footprint's, in cells
constexpr double kMostSummedMean = 3.75;              // beyond it a draw rounds a real number
constexpr double kBorder = 1e-4, kFineBorder = 1e-5;  // what floats do not tell apart

bool isNear(double x, double border) {
  return std::abs(x - std::round(x)) < border;
}

// The pixel with its axes renamed so that x is the long one, in cells.
struct LongPixel {
  GridFootprint grid;
  bool swapped = false;  // true: the long axis is v
  double slope = 0;      // of the edge that is longer along it
  double chord = 0;      // across, at any place along it
  glm::dvec2 half{0};    // of the box around the parallelogram
  double det = 0;
};

LongPixel longPixel(const GridFootprint& grid) {
  LongPixel p;
  p.grid = grid;
  const glm::dvec2 box = glm::max(glm::abs(grid.edge_x), glm::abs(grid.edge_y));
  p.swapped = box.y > box.x;
  if (p.swapped) {
    std::swap(p.grid.centre.x, p.grid.centre.y);
    std::swap(p.grid.edge_x.x, p.grid.edge_x.y);
    std::swap(p.grid.edge_y.x, p.grid.edge_y.y);
  }
  const glm::dvec2 &x = p.grid.edge_x, &y = p.grid.edge_y;
  const glm::dvec2 longer = std::abs(x.x) >= std::abs(y.x) ? x : y;
  p.slope = longer.x != 0 ? longer.y / longer.x : 0;
  p.det = x.x * y.y - x.y * y.x;
  p.chord = longer.x != 0 ? std::abs(p.det / longer.x) : 0;
  p.half = 0.5 * (glm::abs(x) + glm::abs(y));
  return p;
}

// Place number `i` of a cell, in cells from its corner.
glm::dvec2 placeOf(std::uint32_t d, int i) {
  std::uint32_t h = (d + static_cast<std::uint32_t>(i + 1) * 0x632BE5ABu) * 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  h ^= h >> 16;
  return {((h & 0xFFFFu) + 0.5) * 0x1p-16, ((h >> 16) + 0.5) * 0x1p-16};
}

// Adds the microdetails of one cell.
void addCell(LitDetails& made, const LongPixel& pixel, const glm::dvec2& corner, std::uint32_t d,
             double expected, double factor, double p) {
  const std::int64_t count = wholeNumber(d, expected * factor);
  if (static_cast<double>(count) * p > kMostSummedMean)
    made.heaviest_rounded = std::max(made.heaviest_rounded, 1 / factor);
  const std::int64_t lit = drawZk16(uniformOf(d), count, p);
  for (int i = 0; i < lit; ++i) {
    glm::dvec2 place = placeOf(d, i);
    if (pixel.swapped) std::swap(place.x, place.y);
    const glm::dvec2 from = corner + place - pixel.grid.centre;
    const glm::dvec2 &x = pixel.grid.edge_x, &y = pixel.grid.edge_y;
    const double s = (from.x * y.y - from.y * y.x) / pixel.det;
    const double t = (from.y * x.x - from.x * x.y) / pixel.det;
    const double reach = std::max(std::abs(s), std::abs(t));
    if (reach < 0.5) made.sum += 1 / factor;
    made.tied = made.tied || std::abs(reach - 0.5) < kBorder;
  }
}

// Share of the microdetails that grids have.
double shareOfGrids(LitDetails& made, double microdetails, double probability, double half_length) {
  const double crowd = std::log2(microdetails * probability / kFrom) / kDoublings;
  const double rarity = std::max(-std::log2(probability * std::numbers::e) / kRareDoublings, 0.0);
  const double near = 2 - microdetails * std::min(rarity, 1 / kLeastDetails);
  const double length = (half_length - kLength) / (kMostLength - kLength);
  const double share = std::max({crowd, near, length});
  made.tied = std::abs(share) < kBorder || std::abs(share - 1) < kBorder;
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace

LitDetails litDetails(const PixelFootprint& footprint, const glm::dvec2& stretch,
                      const Glints& glints, double microdetails, double probability,
                      HalfVectorIndex half, bool deep_uv) {
  LitDetails made;
  const double density = glints.density / (stretch.x * stretch.y);
  const double fourths = 0.5 * std::log2(density * probability);
  const int level = std::clamp(static_cast<int>(-std::floor(fourths)), -30, 30);
  const double count = std::ldexp(density, 2 * level);
  const double most = mostExpected(glints.size_variation);
  const LongPixel pixel = longPixel(inGrid(footprint, stretch, level));
  if (glints.groove || probability > 0.5 || microdetails >= most || count > most || pixel.det == 0)
    return made;
  made.of_grids = shareOfGrids(made, microdetails, probability, pixel.half.x);
  made.tied = made.tied || isNear(fourths, kFineBorder);
  if (made.of_grids >= 1) return made;

  const glm::dvec2 &centre = pixel.grid.centre, low = centre - pixel.half,
                   high = centre + pixel.half;
  const double reach = 0.5 * (std::abs(pixel.slope) + pixel.chord);
  const auto floored = [&](double x) {
    made.tied = made.tied || isNear(x, kFineBorder);
    return std::floor(x);
  };
  const std::uint32_t salt = static_cast<std::uint32_t>(level) * 0x632BE5ABu + 0xA511E9B3u;
  for (double i = floored(low.x); i <= floored(high.x); ++i) {
    const double middle = centre.y + pixel.slope * (i + 0.5 - centre.x);
    const double last = floored(std::min(middle + reach, high.y));
    for (double j = floored(std::max(middle - reach, low.y)); j <= last; ++j) {
      std::int64_t u = pixel.grid.base_u + static_cast<std::int64_t>(pixel.swapped ? j : i);
      std::int64_t v = pixel.grid.base_v + static_cast<std::int64_t>(pixel.swapped ? i : j);
      if (!deep_uv) {
        u = wrapped(u);
        v = wrapped(v);
      }
      const std::uint32_t d = pairSeed(plainCellSeed(u, v, salt), half);
      ++made.cells;
      addCell(made, pixel, {i, j}, d, count * (1 - made.of_grids),
              sizeFactor(d, glints.size_variation), probability);
    }
  }
  return made;
}

}  // namespace glintmark::reference
