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

std::int32_t wrap(std::int64_t index) {
  return static_cast<std::int32_t>(static_cast<std::uint64_t>(index));
}

void visitGrid(const GridFootprint& grid, GridVisit& visit) {
  const glm::dvec2 x = 0.5 * grid.edge_x, y = 0.5 * grid.edge_y, c = grid.centre;
  const Polygon outline = {c - x - y, c + x - y, c + x + y, c - x + y};
  double first_u = 0, last_u = 0;
  cellRange(outline, 0, first_u, last_u);
  for (double u = first_u; u <= last_u; u += 1.0) {
    const Polygon column = clippedToSlab(outline, 0, u);
    if (column.empty()) continue;
    double first_v = 0, last_v = 0;
    cellRange(column, 1, first_v, last_v);
    for (double v = first_v; v <= last_v; v += 1.0)
      visit.cells.push_back({wrap(grid.base_u + static_cast<std::int64_t>(u)),
                             wrap(grid.base_v + static_cast<std::int64_t>(v)),
                             areaOf(clippedToSlab(column, 1, v))});
  }
}

}  // namespace

std::vector<GridVisit> visitExact(const PixelFootprint& footprint, const glm::dvec2& stretch) {
  std::vector<GridVisit> grids = gridsFor(cellSizeExact(footprint));
  for (GridVisit& visit : grids) visitGrid(inGrid(footprint, stretch, visit.level), visit);
  return grids;
}

}  // namespace glintmark::reference
