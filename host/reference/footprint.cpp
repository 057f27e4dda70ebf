#include "host/reference/footprint.h"

#include <algorithm>
#include <cmath>

#include "host/reference/beckmann.h"

namespace glintmark::reference {
namespace {

constexpr std::int32_t kOffsetU = 1237;  // "The draws", step 1
constexpr std::int32_t kOffsetV = 2011;
constexpr double kLeastStretch = 0x1p-10;
constexpr double kStretchUnit = 4096;
constexpr double kDerivativeLimit = 0x1p30;
constexpr double kLeastExtent = 0x1p-28;
constexpr double kMostExtent = 0x1p29;
constexpr double kMostExactAspect = 4096;
constexpr int kFinestLevel = -30, kCoarsestLevel = 30;

double sane(double derivative) {
  return std::abs(derivative) < kDerivativeLimit ? derivative : 0.0;  // false for NaN
}

glm::dvec2 sane(const glm::dvec2& d) {
  return {sane(d.x), sane(d.y)};
}

// s = max(A / E, E / limit): A / E is the shorter chord, the paper's max-norm of the inverse.
double cellSize(const PixelFootprint& footprint, double limit) {
  const glm::dvec2 x = sane(footprint.duv_dx), y = sane(footprint.duv_dy);
  const double area = std::abs(x.x * y.y - x.y * y.x);
  const double longest = std::max({std::abs(x.x), std::abs(x.y), std::abs(y.x), std::abs(y.y)});
  const double extent = std::clamp(longest, kLeastExtent, kMostExtent);
  return std::max(area / extent, extent / limit);
}

// Splits a stretched coordinate in units of 2^level into whole cells and the rest. 64 bits of
// mantissa hold every coordinate of interest to well under a cell.
void split(FixedCoordinate c, std::int32_t offset, double stretch, int level, std::int64_t& whole,
           double& rest) {
  const long double coordinate =
      (static_cast<long double>(c.integer) + offset + std::ldexp(1.0L * c.fraction, -32)) * stretch;
  // Stretched coordinates keep 32 bits of fraction.
  const long double kept = std::ldexp(std::floor(std::ldexp(coordinate, 32)), -32);
  const long double cells = std::ldexp(kept, -level);
  const long double below = std::floor(cells);
  whole = static_cast<std::int64_t>(below);
  rest = static_cast<double>(cells - below);
}

}  // namespace

GridRules gridRules(const glm::dvec2& alpha_g, const glm::dvec2& alpha_l, double density) {
  const glm::dvec2 m = mesoRoughness(alpha_g, alpha_l);
  const auto rounded = [](double gamma) {
    return std::clamp(std::round(gamma * kStretchUnit) / kStretchUnit, kLeastStretch, 1.0);
  };
  GridRules rules;
  rules.stretch = {rounded(m.x / m.y), rounded(m.y / m.x)};
  const double per_unit = density / (rules.stretch.x * rules.stretch.y);
  rules.finest_level = std::clamp(static_cast<int>(std::ceil(-0.5 * std::log2(per_unit))),
                                  kFinestLevel, kCoarsestLevel - 1);
  return rules;
}

double footprintArea(const PixelFootprint& footprint) {
  const glm::dvec2 x = sane(footprint.duv_dx), y = sane(footprint.duv_dy);
  return std::abs(x.x * y.y - x.y * y.x);
}

double cellSizeZk16(const PixelFootprint& footprint, int ka) {
  return cellSize(footprint, ka);
}

double cellSizeExact(const PixelFootprint& footprint) {
  return cellSize(footprint, kMostExactAspect);
}

GridFootprint inGrid(const PixelFootprint& footprint, const glm::dvec2& stretch, int level) {
  GridFootprint grid;
  split(footprint.u, kOffsetU, stretch.x, level, grid.base_u, grid.centre.x);
  split(footprint.v, kOffsetV, stretch.y, level, grid.base_v, grid.centre.y);
  const double scale = std::ldexp(1.0, -level);
  grid.edge_x = sane(footprint.duv_dx) * stretch * scale;
  grid.edge_y = sane(footprint.duv_dy) * stretch * scale;
  return grid;
}

std::vector<GridVisit> gridsFor(double cell_size, int finest_level) {
  const double f = std::max(std::log2(cell_size), static_cast<double>(finest_level));
  const double level = std::floor(f);
  std::vector<GridVisit> grids(2);
  grids[0].level = static_cast<int>(level);
  grids[0].mip_weight = 1.0 - (f - level);
  grids[1].level = grids[0].level + 1;
  grids[1].mip_weight = f - level;
  return grids;
}

}  // namespace glintmark::reference
