// Pixel footprints and the cells they visit: kernels/README.md, "Which cells"; [ZK16] Sect. 4.2.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace glintmark::reference {

/// A texture coordinate as the planes store it: integer + fraction / 2^32.
struct FixedCoordinate {
  std::int32_t integer = 0;
  std::uint32_t fraction = 0;
};

/// One pixel's parallelogram in texture space, before stretching.
struct PixelFootprint {
  FixedCoordinate u, v;           // of the pixel's centre
  glm::dvec2 duv_dx{}, duv_dy{};  // uv per pixel
};

/// What the grids of one material have in common.
struct GridRules {
  glm::dvec2 stretch{1.0};  // scale of each axis, in [2^-10, 1]. [ZK16] Sect. 4.4
  int finest_level = -30;   // the first whose cells hold a microdetail each. [ZK16] Sect. 3
};
/// In uv; derivatives that are no numbers count as 0.
double footprintArea(const PixelFootprint& footprint);
/// Step 1 of "The draws"; `density`: microdetails per unit uv area.
GridRules gridRules(const glm::dvec2& alpha_g, const glm::dvec2& alpha_l, double density);

/// One visited cell of one grid.
struct Cell {
  std::int64_t u = 0, v = 0;
  double weight = 0;
};

/// An index modulo 2^32.
inline std::int32_t wrapped(std::int64_t index) {
  return static_cast<std::int32_t>(static_cast<std::uint64_t>(index));
}

/// One of a pixel's two grids.
struct GridVisit {
  int level = 0;          // cells are 2^level wide
  double mip_weight = 0;  // of this grid in the pixel
  std::vector<Cell> cells;
  bool limited = false;  // a guard cut the walk
  bool tied = false;     // some position lies exactly between two columns, and rounding decides
};

/// Cell size s of method zk16 (K_a = `ka`) in uv, before rounding to powers of two.
double cellSizeZk16(const PixelFootprint& footprint, int ka);
/// The same of method exact.
double cellSizeExact(const PixelFootprint& footprint);

/// The footprint in units of one grid's cells, stretched. Shared by both methods.
struct GridFootprint {
  glm::dvec2 centre{};  // relative to cell (base_u, base_v)
  std::int64_t base_u = 0, base_v = 0;
  glm::dvec2 edge_x{}, edge_y{};  // cells per pixel
};
GridFootprint inGrid(const PixelFootprint& footprint, const glm::dvec2& stretch, int level);

/// Levels floor(log2 size) and one above, none below the finest, with their mip weights; no cells
/// yet.
std::vector<GridVisit> gridsFor(double cell_size, int finest_level);

/// Cells of both grids by method zk16; none of the coarser one where that weighs nothing.
std::vector<GridVisit> visitZk16(const PixelFootprint& footprint, const GridRules& rules, int ka);
/// Cells of both grids by method exact; weights are areas in cells.
std::vector<GridVisit> visitExact(const PixelFootprint& footprint, const GridRules& rules);

}  // namespace glintmark::reference
