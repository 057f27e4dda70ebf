#include "host/reference/pixel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/reference/beckmann.h"
#include "host/reference/binomial.h"

namespace glintmark::reference {
namespace {

constexpr double kLeastHalfCell = 4e-5;
constexpr double kLeastProbability = 1e-12;  // shade.cl leaves lights below it out

glm::dvec3 toLocal(const ShadingFrame& frame, const glm::dvec3& w) {
  return {glm::dot(frame.tangent, w), glm::dot(frame.bitangent, w), glm::dot(frame.normal, w)};
}

std::int32_t floorToIndex(double x) {
  return static_cast<std::int32_t>(std::floor(std::clamp(x, -0x1p31, 0x1p31 - 1.0)));
}

// Mean above which some method rounds a real number; the smallest of the methods' limits.
constexpr double kMostExactMean = 3.75;

// What the draws of one pixel and light have in common.
struct LightDraw {
  double probability;
  HalfVectorIndex half;
  const Glints& glints;
  glm::dvec2 stretch;
  bool exact;
};

CellContent contentOf(const Cell& cell, int level, const LightDraw& draw) {
  const double mean =
      std::ldexp(draw.glints.density, 2 * level) / (draw.stretch.x * draw.stretch.y);
  return cellContent(pairSeed(cellSeed(cell.u, cell.v), draw.half), mean,
                     draw.glints.size_variation);
}

// Adds one grid's share of reflecting microdetails, relative to its expectation: Listing 1, lines
// 10 to 24.
double gridRatio(const GridVisit& grid, const LightDraw& draw, double& rounding) {
  double sum = 0, weight = 0;
  for (const Cell& cell : grid.cells) weight += cell.weight;
  if (weight <= 0) return 0;
  const double p = draw.probability;
  for (const Cell& cell : grid.cells) {
    if (cell.weight <= 0) continue;
    const CellContent content = contentOf(cell, grid.level, draw);
    const std::int64_t k = draw.exact ? drawExact(content.draw, content.count, p)
                                      : drawZk16(content.draw, content.count, p);
    const double one = cell.weight / weight / (static_cast<double>(content.count) * p);
    sum += one * static_cast<double>(k);
    if (static_cast<double>(content.count) * std::min(p, 1.0 - p) > kMostExactMean)
      rounding = std::max(rounding, grid.mip_weight * one);
  }
  return grid.mip_weight * sum;
}

}  // namespace

HalfVectorIndex halfVectorIndex(const glm::dvec3& half, const Glints& glints) {
  // A cell covers a microdetail's effective area pi alpha^2 in slopes; the paraboloid map halves.
  const glm::dvec2 side =
      glm::max(0.5 * std::sqrt(std::numbers::pi) * glints.alpha_l, glm::dvec2(kLeastHalfCell));
  const double scale = 65536.0 / (1.0 + std::max(half.z, 0.0));
  return {glints.groove ? 0 : floorToIndex(half.x * scale / side.x),
          floorToIndex(half.y * scale / side.y)};
}

PixelResult evaluatePixel(const SurfacePixel& pixel, const Glints& glints,
                          std::span<const PointLight> lights, const GlintMethodOptions& options) {
  const GridRules rules = gridRules(glints.alpha_g, glints.alpha_l, glints.density, glints.groove);
  const glm::dvec2 stretch = rules.stretch;
  const std::vector<GridVisit> grids = options.exact
                                           ? visitExact(pixel.footprint, rules)
                                           : visitZk16(pixel.footprint, rules, options.ka);
  const glm::dvec3 o = toLocal(pixel.frame, pixel.view);

  PixelResult result;
  for (const PointLight& light : lights) {
    const glm::dvec3 i = toLocal(pixel.frame, light.direction);
    const double p = reflectProbability(i, o, glints.alpha_g, glints.alpha_l, glints.groove);
    const glm::dvec3 smooth =
        glints.intensity * light.irradiance * brdfTimesCosine(i, o, glints.alpha_g, glints.f0);
    result.smooth += smooth;
    if (p <= kLeastProbability) continue;
    const HalfVectorIndex half = halfVectorIndex(glm::normalize(i + o), glints);
    const LightDraw draw = {p, half, glints, stretch, options.exact};
    for (const GridVisit& grid : grids) {
      result.radiance += smooth * gridRatio(grid, draw, result.rounding);
      result.tied = result.tied || grid.tied;
      result.cells += static_cast<std::uint32_t>(grid.cells.size());
      result.limited = result.limited || grid.limited;
    }
  }
  return result;
}

}  // namespace glintmark::reference
