// Method zk16: steps along the longer median of the parallelogram. [ZK16] Sect. 4.2, Fig. 6
#include <algorithm>
#include <cmath>
#include <utility>

#include "host/reference/footprint.h"

namespace glintmark::reference {
namespace {

// One grid with its axes renamed so that x is the long one.
struct LongFirst {
  glm::dvec2 centre{}, edge{};  // edge: the one that is longer along the long axis
  double extent = 0;            // side of the box around the edge centres
  bool swapped = false;         // true: the long axis is v
};

LongFirst longFirst(const GridFootprint& grid) {
  const glm::dvec2 box = glm::max(glm::abs(grid.edge_x), glm::abs(grid.edge_y));
  LongFirst f;
  f.swapped = box.y > box.x;
  const int long_axis = f.swapped ? 1 : 0;
  f.extent = box[long_axis];
  f.edge = std::abs(grid.edge_x[long_axis]) >= std::abs(grid.edge_y[long_axis]) ? grid.edge_x
                                                                                : grid.edge_y;
  f.centre = grid.centre;
  if (f.swapped) {
    std::swap(f.edge.x, f.edge.y);
    std::swap(f.centre.x, f.centre.y);
  }
  return f;
}

void visitGridZk16(const GridFootprint& grid, int ka, GridVisit& visit) {
  const LongFirst f = longFirst(grid);
  const double r = std::max(0.5 * (f.extent - 1.0), 0.0);
  // Cell i has its centre at i + 1/2; those in (c - r - 1, c + r + 1] take part.
  const double first = std::floor(f.centre.x - r - 1.5) + 1.0;
  const double last = std::floor(f.centre.x + r + 0.5);
  const int n = static_cast<int>(last - first) + 1;
  const int most = std::max(ka, 2);
  visit.limited = n > most;
  const int taken = std::min(n, most);
  // Where the limit bites, the positions spread evenly over the n cells and each stands for the
  // cell it lies in; weights then fall to 0 over one stride instead of one cell.
  const double stride = static_cast<double>(n) / taken;
  const double covered = std::max(f.extent, 1.0);
  const double slope = f.edge.x != 0 ? f.edge.y / f.edge.x : 0.0;

  for (int j = 0; j < taken; ++j) {
    const double position = first + (j + 0.5) * stride;
    const double index = std::floor(position);
    visit.tied = visit.tied || (visit.limited && position == index);
    const double reach = 0.5 * (covered + stride) - std::abs(position - f.centre.x);
    const double along = std::clamp(reach / stride, 0.0, 1.0);
    const double across = f.centre.y + (index + 0.5 - f.centre.x) * slope - 0.5;
    const double below = std::floor(across);
    for (int side = 0; side < 2; ++side) {
      std::int64_t u = static_cast<std::int64_t>(index);
      std::int64_t v = static_cast<std::int64_t>(below) + side;
      if (f.swapped) std::swap(u, v);
      const double share = side == 1 ? across - below : 1.0 - (across - below);
      visit.cells.push_back({grid.base_u + u, grid.base_v + v, along * share});
    }
  }
}

}  // namespace

std::vector<GridVisit> visitZk16(const PixelFootprint& footprint, const GridRules& rules, int ka) {
  std::vector<GridVisit> grids = gridsFor(cellSizeZk16(footprint, ka), rules.finest_level);
  for (GridVisit& visit : grids) {
    const bool is_coarse = &visit != &grids.front();
    if (is_coarse && visit.mip_weight <= 0) continue;  // below the finest level
    visitGridZk16(inGrid(footprint, rules.stretch, visit.level), ka, visit);
  }
  return grids;
}

}  // namespace glintmark::reference
