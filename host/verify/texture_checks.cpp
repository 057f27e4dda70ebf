// The texture fetch against the double-precision reference: footprints, levels, borders, widths.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "host/harness/texture_harness.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kMostProbes = 16;
constexpr reference::ProbeLimits kOneRow{kMostProbes, 1};
// Around whole ratios rounding decides the number of probes, and so it does elsewhere.
constexpr double kMargin = 1e-4;

reference::ProbeGrid referenceGrid(const TestTexture& texture, const TexturePixel& p,
                                   const reference::ProbeLimits& most) {
  return reference::footprintProbes(
      static_cast<int>(texture.header.width), static_cast<int>(texture.header.height),
      static_cast<int>(texture.header.level_count), {p.u * 0x1p-32, p.v * 0x1p-32},
      {{p.dudx, p.dvdx}, {p.dudy, p.dvdy}}, most);
}

struct Shape {
  int width, height, texel_size;
  reference::ProbeLimits most = kOneRow;
};
constexpr Shape kShapes[] = {{64, 64, 1},
                             {64, 64, 4},
                             {37, 19, 1},
                             {1, 1, 1},
                             {1, 53, 2},
                             {96, 1, 1},
                             {33, 65, 8},
                             {20, 30, 3},
                             {20, 30, 6},
                             {64, 64, 1, {kMostProbes, 2}},
                             {37, 19, 4, {kMostProbes, 4}},
                             {1, 53, 1, {kMostProbes, 2}},
                             {20, 30, 3, {4, 4}},
                             {64, 32, 2, {kMostProbes, 2, 2.5}}};

std::string nameOf(const Shape& shape) {
  const std::string name =
      fmt::format("texture/{}x{}_of_{}", shape.width, shape.height, shape.texel_size);
  return shape.most.rows == 1 ? name : fmt::format("{}_{}_rows", name, shape.most.rows);
}

Finding fetchesMatchReference(const CheckContext& context, const Shape& shape) {
  const TestTexture texture = randomTexture(shape.width, shape.height, shape.texel_size, 7);
  const std::vector<TexturePixel> pixels = randomFootprints(400, 11);
  const auto fetched = fetchPixels(context.bench, texture, shape.texel_size, pixels, shape.most,
                                   true, context.lanes);
  Finding finding(kFetchTolerance);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const reference::ProbeGrid grid = referenceGrid(texture, pixels[i], shape.most);
    finding.require(std::abs(fetched[i].level - grid.level) <= kLevelTolerance,
                    fmt::format("level {} instead of {}", fetched[i].level, grid.level));
    if (grid.margin < kMargin) continue;
    ++compared;
    finding.require(fetched[i].count == grid.count && fetched[i].rows == grid.rows,
                    fmt::format("{} by {} probes instead of {} by {}", fetched[i].count,
                                fetched[i].rows, grid.count, grid.rows));
    const std::vector<double> expected = reference::filterTexture(texture.levels, grid, true);
    for (std::size_t c = 0; c < expected.size(); ++c)
      finding.add(std::abs(fetched[i].values[c] - expected[c]));
  }
  finding.require(compared > pixels.size() / 2, "too few footprints to compare");
  return finding;
}

Finding clampedBorders(const CheckContext& context) {
  const TestTexture texture = randomTexture(16, 16, 1, 3);
  std::vector<TexturePixel> pixels(2);
  pixels[1].u = pixels[1].v = 0xFFFFFFFFu;
  const auto fetched = fetchPixels(context.bench, texture, 1, pixels, {}, false, context.lanes);
  Finding finding(kFetchTolerance);
  finding.add(std::abs(fetched[0].values[0] - texture.texels[0].x));
  finding.add(std::abs(fetched[1].values[0] - texture.texels[255].x));
  return finding;
}

Finding badDerivatives(const CheckContext& context) {
  const TestTexture texture = randomTexture(16, 16, 1, 3);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  std::vector<TexturePixel> pixels;
  for (const float bad : {kNan, kInfinite, -kInfinite, 0.0f, 1e-38f, 1e30f, -1e30f})
    for (const float other : {0.0f, 1e-3f, bad})
      pixels.push_back({1u << 30, 1u << 29, bad, other, other, bad});
  Finding finding(0);
  double bad = 0;
  for (const FetchedTexel& texel :
       fetchPixels(context.bench, texture, 1, pixels, {kMostProbes, 2}, true, context.lanes))
    bad += !(std::abs(texel.values[0]) <= 1) || texel.count < 1 || texel.count > kMostProbes ||
           texel.rows < 1 || texel.rows > kMostProbes;
  finding.add(bad);
  return finding;
}

// One probe is at least as wide as the major axis.
Finding isotropicProbe(const CheckContext& context) {
  const TestTexture texture = randomTexture(64, 64, 1, 3);
  const auto fetched = fetchPixels(context.bench, texture, 1, {{0, 0, 0.25f, 0, 0, 0.015625f}}, {},
                                   true, context.lanes);
  Finding finding(kLevelTolerance);
  finding.require(fetched[0].count == 1, "more than one probe");
  finding.add(std::abs(fetched[0].level - std::log2(16 / std::sqrt(3.0))));
  return finding;
}

// Between the centres of two texels the interpolated variance is a sixth of their squared
// difference; a footprint of p texels has p^2 / 12 of its own, never more: p^2 / 2 of it along each
// axis of the footprint's ellipse.
Finding magnifiedFootprints(const CheckContext& context) {
  const TestTexture texture = randomTexture(64, 32, 1, 7);
  const std::vector<TexturePixel> pixels = randomFootprints(1000, 13);
  const auto fetched = fetchPixels(context.bench, texture, 1, pixels, kOneRow, true, context.lanes);
  Finding finding(kLevelTolerance);
  int small = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const TexturePixel& p = pixels[i];
    const glm::dvec2 size(64, 32), x = glm::dvec2(p.dudx, p.dvdx) * size,
                                   y = glm::dvec2(p.dudy, p.dvdy) * size;
    const double trace = glm::dot(x, x) + glm::dot(y, y), area = x.x * y.y - x.y * y.x;
    const double root = std::sqrt(std::max(trace * trace - 4 * area * area, 0.0));
    const double want =
        (std::min(0.5 * (trace + root), 2.0) + std::min(0.5 * (trace - root), 2.0)) / 4;
    finding.add(std::abs(fetched[i].true_spread - want));
    small += want < 0.9;
  }
  finding.require(small > 100, "too few footprints are small");
  return finding;
}

Finding sameFetches(const CheckContext& context) {
  const TestTexture texture = randomTexture(48, 31, 4, 3);
  const std::vector<TexturePixel> pixels = randomFootprints(333, 5);
  Finding finding(0);
  for (const int rows : {1, 2}) {
    const reference::ProbeLimits most{kMostProbes, rows};
    const auto one = fetchPixels(context.bench, texture, 4, pixels, most, true, 1);
    const auto wide = fetchPixels(context.bench, texture, 4, pixels, most, true, context.lanes);
    double different = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      for (std::size_t c = 0; c < 16; ++c)
        different += std::bit_cast<std::uint32_t>(one[i].values[c]) !=
                     std::bit_cast<std::uint32_t>(wide[i].values[c]);
    finding.add(different);
  }
  return finding;
}

}  // namespace

std::vector<Check> textureChecks() {
  std::vector<Check> checks;
  for (const Shape& shape : kShapes)
    checks.push_back({nameOf(shape), "absolute error", [&shape](const CheckContext& context) {
                        return fetchesMatchReference(context, shape);
                      }});
  checks.insert(checks.end(),
                {{"texture/clamped_borders", "absolute error", clampedBorders},
                 {"texture/bad_derivatives", "fetches out of range", badDerivatives},
                 {"texture/isotropic_level", "error of the level", isotropicProbe},
                 {"texture/magnified", "error of the share of variance", magnifiedFootprints},
                 {"texture/same_bits", "values that differ from one lane's", sameFetches}});
  return checks;
}

}  // namespace glintmark
