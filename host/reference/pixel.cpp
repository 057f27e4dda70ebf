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

// Share of reflecting microdetails in the pixel: Listing 1, lines 9 to 24.
double pixelShare(std::span<const GridVisit> grids, double probability, HalfVectorIndex half,
                  const Glints& glints, const glm::dvec2& stretch, bool exact) {
  double share = 0;
  for (const GridVisit& grid : grids) {
    double sum = 0, weight = 0;
    for (const Cell& cell : grid.cells) {
      weight += cell.weight;
      if (cell.weight > 0)
        sum += cell.weight * cellShare(cell, grid.level, probability, half, glints, stretch, exact);
    }
    if (weight > 0) share += grid.mip_weight * sum / weight;
  }
  return share;
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

double cellShare(const Cell& cell, int level, double probability, HalfVectorIndex half,
                 const Glints& glints, const glm::dvec2& stretch, bool exact) {
  const double mean = std::ldexp(glints.density, 2 * level) / (stretch.x * stretch.y);
  const CellContent content =
      cellContent(pairSeed(cellSeed(cell.u, cell.v), half), mean, glints.size_variation);
  const std::int64_t k = exact ? drawExact(content.draw, content.count, probability)
                               : drawZk16(content.draw, content.count, probability);
  return static_cast<double>(k) / content.expected;
}

PixelResult evaluatePixel(const SurfacePixel& pixel, const Glints& glints,
                          std::span<const PointLight> lights, const GlintMethodOptions& options) {
  const glm::dvec2 stretch = options.stretch.value_or(gridStretch(glints.alpha_g, glints.alpha_l));
  const std::vector<GridVisit> grids = options.exact
                                           ? visitExact(pixel.footprint, stretch)
                                           : visitZk16(pixel.footprint, stretch, options.ka);
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
    result.radiance += smooth * (pixelShare(grids, p, half, glints, stretch, options.exact) / p);
    for (const GridVisit& grid : grids) {
      result.cells += static_cast<std::uint32_t>(grid.cells.size());
      result.limited = result.limited || grid.limited;
    }
  }
  return result;
}

}  // namespace glintmark::reference
