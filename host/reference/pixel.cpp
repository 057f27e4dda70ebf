#include "host/reference/pixel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/reference/beckmann.h"
#include "host/reference/binomial.h"
#include "host/reference/lit_details.h"
#include "host/reference/rivals.h"

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
// Of a pixel's reflecting microdetails, from which on method distributed lowers the limits, and how
// far at most.
constexpr double kCrowd = 64, kLeastLimits = 0.02;

// What the draws of one pixel and light have in common.
struct LightDraw {
  double probability;
  HalfVectorIndex half;
  const Glints& glints;
  glm::dvec2 stretch;
  bool exact;
  bool deep_uv;

  std::uint32_t seedOf(const Cell& cell, std::uint32_t salt = 0) const {
    return deep_uv ? cellSeed(cell.u, cell.v, salt)
                   : cellSeed(wrapped(cell.u), wrapped(cell.v), salt);
  }
};

double weightOf(const GridVisit& grid) {
  double weight = 0;
  for (const Cell& cell : grid.cells) weight += cell.weight;
  return weight;
}

std::int64_t drawn(std::uint32_t d, std::int64_t count, const LightDraw& draw, double limits = 1) {
  const double u = uniformOf(d);
  return draw.exact ? drawExact(u, count, draw.probability)
                    : drawZk16(u, count, draw.probability, limits);
}

bool roundsReals(double count, double p, double limits = 1) {
  return count * std::min(p, 1.0 - p) > kMostExactMean * limits;
}

// Adds one grid's share of reflecting microdetails, relative to its expectation: Listing 1, lines
// 10 to 24.
double gridRatio(const GridVisit& grid, const LightDraw& draw, double& rounding) {
  const double weight = weightOf(grid), p = draw.probability;
  if (weight <= 0) return 0;
  const double v = draw.glints.size_variation;
  const double mean =
      std::min(std::ldexp(draw.glints.density, 2 * grid.level) / (draw.stretch.x * draw.stretch.y),
               mostExpected(v));
  double sum = 0;
  for (const Cell& cell : grid.cells) {
    if (cell.weight <= 0) continue;
    const std::uint32_t d = pairSeed(draw.seedOf(cell), draw.half);
    const auto count = std::max<std::int64_t>(wholeNumber(d, mean * sizeFactor(d, v)), 1);
    const double one = cell.weight / weight / (static_cast<double>(count) * p);
    sum += one * static_cast<double>(drawn(d, count, draw));
    if (roundsReals(static_cast<double>(count), p))
      rounding = std::max(rounding, grid.mip_weight * one);
  }
  return grid.mip_weight * sum;
}

// The same of both grids by method distributed, which shares out `microdetails` among their cells.
double distributedRatio(std::span<const GridVisit> grids, double microdetails,
                        const LightDraw& draw, double& rounding) {
  struct Share {
    std::uint32_t d;
    double factor, expected;
    std::int64_t count;
  };
  std::vector<Share> shares;
  const double v = draw.glints.size_variation, p = draw.probability;
  double all = 0, most = 0;
  for (const GridVisit& grid : grids) {
    const double weight = weightOf(grid);
    for (const Cell& cell : grid.cells) {
      const auto salt = static_cast<std::uint32_t>(grid.level) * 0x632BE5ABu;
      const std::uint32_t d = pairSeed(draw.seedOf(cell, salt), draw.half);
      Share share = {d, sizeFactor(d, v), 0, 0};
      share.expected = grid.mip_weight * cell.weight / weight * microdetails * share.factor;
      share.count = wholeNumber(d, share.expected);
      all += static_cast<double>(share.count) / share.factor;
      most = std::max(most, share.expected);
      shares.push_back(share);
    }
  }
  if (all == 0) {  // the cell with the largest share gets the one there is
    for (Share& share : shares) {
      share.count = share.expected * 1.00001 >= most ? 1 : 0;
      all += static_cast<double>(share.count) / share.factor;
    }
  }
  const double lit = microdetails * std::min(p, 1 - p);
  const double limits = std::clamp(kCrowd / lit, kLeastLimits, 1.0);
  double sum = 0;
  for (const Share& share : shares) {
    const double one = 1 / (share.factor * all * p);
    sum += one * static_cast<double>(drawn(share.d, share.count, draw, limits));
    if (roundsReals(static_cast<double>(share.count), p, limits))
      rounding = std::max(rounding, one);
  }
  return sum;
}

// Microdetails that method distributed shares out. Grooves are as long as a stretched cell: those
// that pass through a pixel are more than begin in it.
double sharedMicrodetails(const PixelFootprint& footprint, std::span<const GridVisit> grids,
                          const Glints& glints, const glm::dvec2& stretch) {
  double count = glints.density * footprintArea(footprint);
  if (glints.groove) {
    const double cell = std::exp2(grids[0].level + grids[1].mip_weight);
    const GridFootprint grid = inGrid(footprint, stretch, 0);
    const glm::dvec2 extent = glm::max(glm::abs(grid.edge_x), glm::abs(grid.edge_y));
    for (int axis = 0; axis < 2; ++axis)
      count /= std::clamp(extent[axis] / cell, stretch[axis], 1.0);
  }
  return std::clamp(count, 1.0, mostExpected(glints.size_variation));
}

// Methods that have no grids of ours.
bool isRival(GlintRule method) {
  return method != GlintRule::kZk16 && method != GlintRule::kExact &&
         method != GlintRule::kDistributed;
}

RivalRatio rivalRatio(GlintRule method, const PixelFootprint& footprint, const Glints& glints,
                      const RivalLight& light) {
  if (method == GlintRule::kKemppinen) return kemppinen(footprint, glints, light);
  if (method == GlintRule::kChermain || method == GlintRule::kChermainCorrected)
    return chermain(footprint, glints, light, method == GlintRule::kChermain);
  if (method == GlintRule::kPublishedZk16) return publishedZk16(footprint, glints, light);
  return deliotBelcour(footprint, glints, light, method == GlintRule::kDeliotBelcour);
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
  const GridRules rules = gridRules(glints.alpha_g, glints.alpha_l, glints.density);
  const glm::dvec2 stretch = rules.stretch;
  const bool exact = options.method == GlintRule::kExact;
  const bool rival = isRival(options.method);
  const std::vector<GridVisit> grids = rival   ? std::vector<GridVisit>()
                                       : exact ? visitExact(pixel.footprint, rules)
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
    if (rival) {
      const RivalRatio ratio =
          rivalRatio(options.method, pixel.footprint, glints, {p, glm::normalize(i + o)});
      result.radiance += smooth * ratio.ratio;
      result.cells += ratio.visited;
      result.limited = result.limited || ratio.limited;
      continue;
    }
    const HalfVectorIndex half = halfVectorIndex(glm::normalize(i + o), glints);
    const LightDraw draw = {p, half, glints, stretch, exact, options.deep_uv};
    const bool distributed = options.method == GlintRule::kDistributed;
    if (distributed) {
      const double microdetails = sharedMicrodetails(pixel.footprint, grids, glints, stretch);
      const LitDetails lit =
          litDetails(pixel.footprint, stretch, glints, microdetails, p, half, options.deep_uv);
      const double one = 1 / (microdetails * p);
      result.radiance += smooth * lit.sum * one;
      result.rounding = std::max(result.rounding, lit.heaviest_rounded * one);
      result.cells += lit.cells;
      result.tied = result.tied || lit.tied;
      if (lit.of_grids <= 0) continue;
      result.radiance +=
          smooth * lit.of_grids *
          distributedRatio(grids, lit.of_grids * microdetails, draw, result.rounding);
    }
    for (const GridVisit& grid : grids) {
      if (!distributed) result.radiance += smooth * gridRatio(grid, draw, result.rounding);
      result.tied = result.tied || grid.tied;
      result.cells += static_cast<std::uint32_t>(grid.cells.size());
      result.limited = result.limited || grid.limited;
    }
  }
  return result;
}

}  // namespace glintmark::reference
