// Method exact: every cell under the parallelogram, by the area of the polygon they share.
#include <algorithm>
#include <cmath>

#include "host/reference/footprint.h"

namespace glintmark::reference {
namespace {

using Polygon = std::vector<glm::dvec2>;

// Part of a convex polygon where sign * coordinate[axis] >= sign * limit (Sutherland and Hodgman
// 1974, one half-plane).
Polygon clipped(const Polygon& polygon, int axis, double limit, double sign) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
    if (da >= 0) result.push_back(a);
    if ((da >= 0) != (db >= 0)) result.push_back(a + (b - a) * (da / (da - db)));
  }
  return result;
}

Polygon clippedToSlab(const Polygon& polygon, int axis, double low) {
  return clipped(clipped(polygon, axis, low, 1.0), axis, low + 1.0, -1.0);
}

double areaOf(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(twice);
}

// Cells [first, last] that the polygon's interior meets along an axis.
void cellRange(const Polygon& polygon, int axis, double& first, double& last) {
  double low = polygon[0][axis], high = low;
  for (const glm::dvec2& p : polygon) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  first = std::floor(low);
  last = std::max(first, std::ceil(high) - 1.0);
}

constexpr double kLeastArea = 1e-6;        // of a cell, for a cell to count as touched
constexpr double kLeastSide = 0x1p-8;      // of the least footprint, in cells of the finer grid
constexpr double kMostColumns = 4096;      // per grid
constexpr double kMostAspect = 4096;       // slimmer footprints are widened
constexpr double kLeastEdge_uv = 0x1p-28;  // uv; shorter edge vectors have no direction

double longestEntry(const glm::dvec2& d) {
  return std::max(std::abs(d.x), std::abs(d.y));
}

// A footprint of no area, or hardly any, becomes a thin box along its longer edge.
PixelFootprint widened(const PixelFootprint& footprint) {
  const glm::dvec2 x = footprint.duv_dx, y = footprint.duv_dy;
  const double extent = std::max({longestEntry(x), longestEntry(y), kLeastEdge_uv});
  if (std::abs(x.x * y.y - x.y * y.x) >= extent * extent / kMostAspect) return footprint;
  PixelFootprint box = footprint;
  const glm::dvec2 longer = glm::dot(x, x) >= glm::dot(y, y) ? x : y;
  box.duv_dx = longestEntry(longer) < kLeastEdge_uv ? glm::dvec2(extent, 0) : longer;
  box.duv_dy = glm::normalize(glm::dvec2(-box.duv_dx.y, box.duv_dx.x)) * cellSizeExact(footprint);
  return box;
}

// A footprint of less area than a square of side `least` becomes a box.
void widenSpeck(GridFootprint& grid, double least) {
  const glm::dvec2 x = grid.edge_x, y = grid.edge_y;
  if (std::abs(x.x * y.y - x.y * y.x) >= least * least) return;
  const glm::dvec2 box = glm::max(glm::max(glm::abs(x), glm::abs(y)), glm::dvec2(least));
  grid.edge_x = {box.x, 0};
  grid.edge_y = {0, box.y};
}

void visitGridExact(const GridFootprint& grid, GridVisit& visit) {
  const glm::dvec2 x = 0.5 * grid.edge_x, y = 0.5 * grid.edge_y, c = grid.centre;
  const Polygon outline = {c - x - y, c + x - y, c + x + y, c - x + y};
  const glm::dvec2 box = glm::max(glm::abs(grid.edge_x), glm::abs(grid.edge_y));
  const int along = box.y > box.x ? 1 : 0, across = 1 - along;
  double first = 0, last = 0;
  cellRange(outline, along, first, last);
  const double columns = last - first + 1.0;
  visit.limited = columns > kMostColumns;
  const double taken = std::min(columns, kMostColumns);
  for (double j = 0; j < taken; j += 1.0) {
    const double column_index = first + std::floor((j + 0.5) * columns / taken);
    const Polygon column = clippedToSlab(outline, along, column_index);
    if (column.empty()) continue;
    double low = 0, high = 0;
    cellRange(column, across, low, high);
    for (double i = low; i <= high; i += 1.0) {
      const double area = areaOf(clippedToSlab(column, across, i));
      if (area <= kLeastArea) continue;
      const auto u = static_cast<std::int64_t>(along == 0 ? column_index : i);
      const auto v = static_cast<std::int64_t>(along == 0 ? i : column_index);
      visit.cells.push_back({grid.base_u + u, grid.base_v + v, area});
    }
  }
}

}  // namespace

std::vector<GridVisit> visitExact(const PixelFootprint& footprint, const GridRules& rules) {
  std::vector<GridVisit> grids = gridsFor(cellSizeExact(footprint), rules.finest_level);
  const PixelFootprint covered = widened(footprint);
  for (GridVisit& visit : grids) {
    GridFootprint grid = inGrid(covered, rules.stretch, visit.level);
    widenSpeck(grid, std::ldexp(kLeastSide, grids[0].level - visit.level));
    visitGridExact(grid, visit);
  }
  return grids;
}

}  // namespace glintmark::reference
