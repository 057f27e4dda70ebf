// Colours of microdetails, draw by draw: step 10 of "The draws" (kernels/README.md) over the cells
// of the double-precision reference.
#include <algorithm>
#include <cmath>

#include "host/core/float4.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/reference/beckmann.h"
#include "host/reference/binomial.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr glm::dvec3 kPalette[] = {{0.9, 0.1, 0.2}, {0.1, 0.8, 0.3}, {0.2, 0.3, 0.7}, {1, 1, 0}};

// A saturated hue whose mean over the wheel is white: each channel is a trapezium, 2 over a third
// of the wheel and 0 over another.
glm::dvec3 wheelHue(double x) {
  const auto channel = [x](double centre) {
    const double d = std::abs(x - centre), distance = 6 * std::min(d, 1 - d);
    return 2 * std::clamp(2 - distance, 0.0, 1.0);
  };
  return {channel(0), channel(1.0 / 3), channel(2.0 / 3)};
}

glm::dvec3 colourOf(std::uint32_t d, double k, bool wheel) {
  const double x = static_cast<double>((d * 0x1B56C4E9u) >> 8) * 0x1p-24;
  glm::dvec3 mean(1), picked = wheelHue(x);
  if (!wheel) {
    mean = glm::dvec3(0);
    for (const glm::dvec3& c : kPalette) mean += c / static_cast<double>(std::size(kPalette));
    picked = kPalette[static_cast<std::size_t>(x * static_cast<double>(std::size(kPalette)))];
  }
  return mean + (picked - mean) / std::sqrt(std::max(k, 1.0));
}

// One pixel's microdetails by method zk16, relative to the smooth lobe.
struct ColouredPixel {
  glm::dvec3 ratio{0};
  double rounding = 0;  // what one microdetail more adds, where k rounds a real number
};

ColouredPixel colouredPixel(const reference::SurfacePixel& pixel, const reference::Glints& glints,
                            const glm::dvec3& light, bool wheel) {
  const auto local = [&](const glm::dvec3& w) {
    return glm::dvec3(glm::dot(pixel.frame.tangent, w), glm::dot(pixel.frame.bitangent, w),
                      glm::dot(pixel.frame.normal, w));
  };
  const glm::dvec3 i = local(light), o = local(pixel.view);
  const double p = reference::reflectProbability(i, o, glints.alpha_g, glints.alpha_l, false);
  const reference::HalfVectorIndex half = reference::halfVectorIndex(glm::normalize(i + o), glints);
  const reference::GridRules rules =
      reference::gridRules(glints.alpha_g, glints.alpha_l, glints.density);
  ColouredPixel result;
  for (const reference::GridVisit& grid : reference::visitZk16(pixel.footprint, rules, 16)) {
    double weights = 0;
    for (const reference::Cell& cell : grid.cells) weights += cell.weight;
    const double mean =
        std::ldexp(glints.density, 2 * grid.level) / (rules.stretch.x * rules.stretch.y);
    for (const reference::Cell& cell : grid.cells) {
      if (cell.weight <= 0) continue;
      const std::uint32_t d = reference::pairSeed(reference::cellSeed(cell.u, cell.v), half);
      const auto count = std::max<std::int64_t>(reference::wholeNumber(d, mean), 1);
      const auto k = static_cast<double>(reference::drawZk16(reference::uniformOf(d), count, p));
      const double one = grid.mip_weight * cell.weight / weights / (static_cast<double>(count) * p);
      result.ratio += one * k * colourOf(d, k, wheel);
      if (static_cast<double>(count) * std::min(p, 1 - p) > 3.75)
        result.rounding = std::max(result.rounding, 2 * one);
    }
  }
  return result;
}

// Sparse and dense, so that cells reflect by one and by many; every channel of every pixel.
Finding colours(const CheckContext& context, bool wheel) {
  Finding finding(kFlippedPixelShare);
  for (const float density : {1e5f, 1e8f}) {
    HandMadeFrame frame;
    frame.material = simpleMaterial({0.3f, 0.3f}, {0.1f, 0.1f}, density);
    if (!wheel) {
      frame.material.glints.palette_count = static_cast<uint>(std::size(kPalette));
      for (std::size_t i = 0; i < std::size(kPalette); ++i)
        frame.material.glints.palette[i] = toFloat4(kPalette[i]);
    }
    frame.pixels = randomPixels(2000, {1e-4, 1e-2, 20});
    frame.lights = {coneLight({-0.3, 0.2, 0.9})};
    setRandomRays(frame);
    KernelConfig config;
    config.width = context.lanes;
    config.size_variation = false;
    config.glint_colour = true;
    const ShadedPixels coloured = shadePixels(context.bench, frame, config);
    config.glint = config.glint_colour = false;
    const ShadedPixels smooth = shadePixels(context.bench, frame, config);
    const glm::dvec3 light = referenceLights(frame)[0].direction;
    double flipped = 0, lit = 0, several = 0;
    for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
      const ColouredPixel want = colouredPixel(referencePixel(frame, frame.pixels[i]),
                                               referenceGlints(frame.material), light, wheel);
      bool differs = false;
      for (int c = 0; c < 3; ++c) {
        const double got = coloured.radiance[i][c] / smooth.radiance[i][c];
        differs = differs || !(std::abs(got - want.ratio[c]) <=
                               kShareTolerance * std::max(want.ratio[c], 1.0) + 2 * want.rounding);
      }
      flipped += differs;
      lit += want.ratio.x + want.ratio.y > 0;
      several += std::abs(want.ratio.x - want.ratio.y) > 0.01 * want.ratio.x;
    }
    const auto count = static_cast<double>(frame.pixels.size());
    finding.add(flipped / count);
    finding.require(lit > 100 && several > 0.5 * lit, "too few pixels have a colour");
  }
  return finding;
}

}  // namespace

std::vector<Check> colourChecks() {
  return {{"draws/colour_wheel", "share of pixels with other draws",
           [](const CheckContext& context) { return colours(context, true); }},
          {"draws/colour_palette", "share of pixels with other draws",
           [](const CheckContext& context) { return colours(context, false); }}};
}

}  // namespace glintmark
