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
// Around whole ratios rounding decides the number of probes.
constexpr double kRatioMargin = 1e-4;

reference::ProbeLine referenceLine(const TestTexture& texture, const TexturePixel& p) {
  return reference::footprintProbes(
      static_cast<int>(texture.header.width), static_cast<int>(texture.header.height),
      static_cast<int>(texture.header.level_count), {p.u * 0x1p-32, p.v * 0x1p-32},
      {{p.dudx, p.dvdx}, {p.dudy, p.dvdy}}, kMostProbes);
}

bool nearWhole(double ratio) {
  const double x = ratio - 0.01;
  return std::abs(x - std::round(x)) < kRatioMargin;
}

struct Shape {
  int width, height, texel_size;
};
constexpr Shape kShapes[] = {{64, 64, 1}, {64, 64, 4}, {37, 19, 1}, {1, 1, 1},  {1, 53, 2},
                             {96, 1, 1},  {33, 65, 8}, {20, 30, 3}, {20, 30, 6}};

Finding fetchesMatchReference(const CheckContext& context, const Shape& shape) {
  const TestTexture texture = randomTexture(shape.width, shape.height, shape.texel_size, 7);
  const std::vector<TexturePixel> pixels = randomFootprints(400, 11);
  const auto fetched = fetchPixels(context.bench, texture, shape.texel_size, pixels, kMostProbes,
                                   true, context.lanes);
  Finding finding(kFetchTolerance);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const reference::ProbeLine line = referenceLine(texture, pixels[i]);
    finding.require(std::abs(fetched[i].level - line.level) <= kLevelTolerance,
                    fmt::format("level {} instead of {}", fetched[i].level, line.level));
    if (nearWhole(line.ratio)) continue;
    ++compared;
    finding.require(fetched[i].count == line.count,
                    fmt::format("{} probes instead of {}", fetched[i].count, line.count));
    const std::vector<double> expected = reference::filterTexture(texture.levels, line, true);
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
  const auto fetched = fetchPixels(context.bench, texture, 1, pixels, 1, false, context.lanes);
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
       fetchPixels(context.bench, texture, 1, pixels, kMostProbes, true, context.lanes))
    bad += !(std::abs(texel.values[0]) <= 1) || texel.count < 1 || texel.count > kMostProbes;
  finding.add(bad);
  return finding;
}

// One probe is at least as wide as the major axis.
Finding isotropicProbe(const CheckContext& context) {
  const TestTexture texture = randomTexture(64, 64, 1, 3);
  const auto fetched = fetchPixels(context.bench, texture, 1, {{0, 0, 0.25f, 0, 0, 0.015625f}}, 1,
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
  const auto fetched =
      fetchPixels(context.bench, texture, 1, pixels, kMostProbes, true, context.lanes);
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
  const auto one = fetchPixels(context.bench, texture, 4, pixels, kMostProbes, true, 1);
  const auto wide =
      fetchPixels(context.bench, texture, 4, pixels, kMostProbes, true, context.lanes);
  double different = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 16; ++c)
      different += std::bit_cast<std::uint32_t>(one[i].values[c]) !=
                   std::bit_cast<std::uint32_t>(wide[i].values[c]);
  Finding finding(0);
  finding.add(different);
  return finding;
}

}  // namespace

std::vector<Check> textureChecks() {
  std::vector<Check> checks;
  for (const Shape& shape : kShapes)
    checks.push_back(
        {fmt::format("texture/{}x{}_of_{}", shape.width, shape.height, shape.texel_size),
         "absolute error",
         [&shape](const CheckContext& context) { return fetchesMatchReference(context, shape); }});
  checks.insert(checks.end(),
                {{"texture/clamped_borders", "absolute error", clampedBorders},
                 {"texture/bad_derivatives", "fetches out of range", badDerivatives},
                 {"texture/isotropic_level", "error of the level", isotropicProbe},
                 {"texture/magnified", "error of the share of variance", magnifiedFootprints},
                 {"texture/same_bits", "values that differ from one lane's", sameFetches}});
  return checks;
}

}  // namespace glintmark
