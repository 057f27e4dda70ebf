// Pixels of glints: the same cells and the same draws as the double-precision reference, and the
// same bits at every lane count.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/harness/pixel_harness.h"
#include "host/harness/probes.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr auto kZk16 = GlintMethod::kZk16;
constexpr auto kExact = GlintMethod::kExact;
constexpr auto kDistributed = GlintMethod::kDistributed;
constexpr auto kDeliot = GlintMethod::kDeliotBelcour;
constexpr auto kCorrected = GlintMethod::kDeliotCorrected;
constexpr auto kKemppinen = GlintMethod::kKemppinen;
constexpr auto kPublished = GlintMethod::kPublishedZk16;

struct DrawCase {
  const char* name;
  GlintMethod method;
  float2 alpha_g, alpha_l;
  float density;
  float size_variation;
  bool groove;
  int ka;
  FootprintRange footprints;
};

constexpr FootprintRange kUsual{1e-4, 1e-2, 20};
constexpr DrawCase kDrawCases[] = {
    {"zk16_sparse", kZk16, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"zk16_dense", kZk16, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"zk16_varied", kZk16, {.3f, .3f}, {.1f, .1f}, 1e6f, 2, false, 16, kUsual},
    {"zk16_stretched", kZk16, {.4f, .1f}, {.02f, .05f}, 1e6f, 1, false, 16, kUsual},
    {"zk16_groove", kZk16, {.1f, .5f}, {.1f, .02f}, 1e6f, 1, true, 16, kUsual},
    {"zk16_ka4", kZk16, {.3f, .3f}, {.03f, .03f}, 1e7f, 0, false, 4, {1e-4, 1e-2, 64}},
    {"zk16_ka1", kZk16, {.3f, .3f}, {.03f, .03f}, 1e7f, 0, false, 1, {1e-4, 1e-2, 64}},
    {"zk16_ka64", kZk16, {.3f, .3f}, {.03f, .03f}, 1e7f, 0, false, 64, {1e-4, 1e-2, 100}},
    {"zk16_coarse", kZk16, {.3f, .3f}, {.2f, .2f}, 1e-3f, 0, false, 16, kUsual},
    {"zk16_wide_lobe", kZk16, {.3f, .3f}, {.299f, .299f}, 1e6f, 1, false, 16, kUsual},
    {"distributed_sparse", kDistributed, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"distributed_dense", kDistributed, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"distributed_varied", kDistributed, {.3f, .3f}, {.1f, .1f}, 1e6f, 2, false, 16, kUsual},
    {"distributed_stretched", kDistributed, {.4f, .1f}, {.02f, .05f}, 1e6f, 1, false, 16, kUsual},
    {"distributed_groove", kDistributed, {.1f, .5f}, {.1f, .02f}, 1e6f, 1, true, 16, kUsual},
    {"distributed_near", kDistributed, {.3f, .3f}, {.2f, .2f}, 3e3f, 1, false, 16, kUsual},
    {"deliot_belcour_sparse", kDeliot, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"deliot_belcour_dense", kDeliot, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"deliot_belcour_varied", kDeliot, {.4f, .1f}, {.1f, .05f}, 1e6f, 2, false, 16, kUsual},
    {"deliot_belcour_near", kDeliot, {.3f, .3f}, {.2f, .2f}, 3e3f, 0, false, 16, kUsual},
    {"deliot_belcour_groove", kDeliot, {.1f, .5f}, {.1f, .02f}, 1e6f, 0, true, 16, kUsual},
    {"deliot_corrected_sparse", kCorrected, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"deliot_corrected_dense", kCorrected, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"deliot_corrected_varied", kCorrected, {.4f, .1f}, {.1f, .05f}, 1e6f, 2, false, 16, kUsual},
    {"deliot_corrected_near", kCorrected, {.3f, .3f}, {.2f, .2f}, 3e3f, 0, false, 16, kUsual},
    {"deliot_corrected_groove", kCorrected, {.1f, .5f}, {.1f, .02f}, 1e6f, 0, true, 16, kUsual},
    {"kemppinen_sparse", kKemppinen, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"kemppinen_dense", kKemppinen, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"kemppinen_varied", kKemppinen, {.4f, .1f}, {.1f, .05f}, 1e6f, 2, false, 16, kUsual},
    {"kemppinen_near", kKemppinen, {.3f, .3f}, {.2f, .2f}, 3e3f, 0, false, 16, kUsual},
    {"kemppinen_groove", kKemppinen, {.1f, .5f}, {.1f, .02f}, 1e6f, 0, true, 16, kUsual},
    {"published_zk16_sparse", kPublished, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"published_zk16_dense", kPublished, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"published_zk16_varied", kPublished, {.4f, .1f}, {.1f, .05f}, 1e6f, 2, false, 16, kUsual},
    {"published_zk16_groove", kPublished, {.1f, .5f}, {.1f, .02f}, 1e6f, 0, true, 16, kUsual},
    {"exact_sparse", kExact, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"exact_dense", kExact, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"exact_varied", kExact, {.3f, .3f}, {.1f, .1f}, 1e6f, 2, false, 16, kUsual},
    {"exact_stretched", kExact, {.4f, .1f}, {.02f, .05f}, 1e6f, 1, false, 16, kUsual},
    {"exact_groove", kExact, {.1f, .5f}, {.1f, .02f}, 1e6f, 1, true, 16, kUsual},
    {"exact_grazing", kExact, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, {1e-4, 1e-3, 500}}};

HandMadeFrame drawFrame(const DrawCase& c) {
  HandMadeFrame frame;
  frame.material = simpleMaterial(c.alpha_g, c.alpha_l, c.density, c.size_variation);
  frame.pixels = randomPixels(2000, c.footprints);
  frame.lights = {coneLight({-0.3, 0.2, 0.9})};
  setRandomRays(frame);
  return frame;
}

ShadedPixels drawPixels(const CheckContext& context, const DrawCase& c,
                        const HandMadeFrame& frame) {
  KernelConfig config;
  config.width = context.lanes;
  config.method = c.method;
  config.ka = c.ka;
  config.groove = c.groove;
  config.size_variation = c.size_variation > 0;
  config.count_cells = true;
  return shadePixels(context.bench, frame, config);
}

// How many pixels may have other draws.
double flippedShare(GlintMethod method) {
  return method == kPublished ? kSineHashPixelShare
         : method == kDeliot  ? kRoundedPixelShare
                              : kFlippedPixelShare;
}

// Pixel by pixel: the same cells, the same draws, the same radiance relative to the smooth lobe, so
// that the approximations in the lobe stay out of it.
Finding drawForDraw(const CheckContext& context, const DrawCase& c) {
  const HandMadeFrame frame = drawFrame(c);
  const ShadedPixels shaded = drawPixels(context, c, frame);
  KernelConfig smooth_config;
  smooth_config.width = context.lanes;
  smooth_config.glint = false;
  const ShadedPixels smooth = shadePixels(context.bench, frame, smooth_config);
  const std::vector<reference::PointLight> lights = referenceLights(frame);
  reference::GlintMethodOptions options;
  options.method = referenceRule(c.method);
  options.ka = c.ka;

  const double most_flipped = flippedShare(c.method);
  Finding finding(most_flipped);
  double different_counts = 0, flipped = 0, sum = 0, sum_reference = 0;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const reference::PixelResult expected =
        reference::evaluatePixel(referencePixel(frame, frame.pixels[i]),
                                 referenceGlints(frame.material, c.groove), lights, options);
    const double difference = std::abs(static_cast<double>(shaded.cells[i]) - expected.cells);
    finding.require(
        difference <= (c.method == kExact ? 2 : 0),
        fmt::format("pixel {} visits {} cells, not {}", i, shaded.cells[i], expected.cells));
    finding.require(shaded.limited[i] == expected.limited,
                    fmt::format("pixel {} is not limited as the reference is", i));
    different_counts += difference != 0;
    if (expected.cells == 0 || expected.tied) continue;
    const double got = shaded.radiance[i].x / smooth.radiance[i].x;
    const double want = expected.radiance.x / expected.smooth.x;
    finding.require(std::isfinite(got) && got >= 0, fmt::format("pixel {} is {}", i, got));
    const double error = std::abs(got - want) / std::max(want, 1.0);
    flipped += !(error <= kShareTolerance + 2 * expected.rounding);
    sum += got;
    sum_reference += want;
  }
  const auto count = static_cast<double>(frame.pixels.size());
  finding.add(flipped / count);
  finding.require(different_counts <= kThresholdCountShare * count, "too many counts differ");
  // The published shader's fireflies come from sums of floats, and the reference has none.
  finding.require(c.method == kPublished || std::abs(sum / sum_reference - 1) <= most_flipped,
                  "the means differ");
  return finding;
}

// [ZK16] Sect. 5: from 8 to 64 cells at K_a = 16. Footprints up to beyond the limit, of any size.
Finding cellRange(const CheckContext& context) {
  const DrawCase c = {"", kZk16, {.3f, .3f}, {.05f, .05f}, 1e6f, 0, false, 16, {1e-5, 1, 200}};
  HandMadeFrame frame = drawFrame(c);
  frame.pixels = randomPixels(20000, c.footprints);
  for (HandMadePixel& pixel : frame.pixels) pixel.frame = flatFrame();
  frame.ray_origin = {0, 0, -1};
  frame.ray_dx = frame.ray_dy = glm::dvec3(0);
  const ShadedPixels shaded = drawPixels(context, c, frame);
  Finding finding(0);
  double outside = 0;
  for (const std::uint32_t cells : shaded.cells)
    outside += cells < 8 || cells > 64 || cells % 2 != 0;
  finding.add(outside);
  const auto [least, most] = std::ranges::minmax(shaded.cells);
  finding.require(least == 8 && most == 64, fmt::format("{} to {} cells", least, most));
  return finding;
}

// Cells paid for, by brute force over the counts: lanes side by side walk as long as the longest of
// them, two steps of two cells at a time.
Finding paidCells(const CheckContext& context) {
  const DrawCase c = {"", kZk16, {.3f, .3f}, {.05f, .05f}, 1e6f, 0, false, 16, {1e-4, 1e-2, 200}};
  HandMadeFrame frame = drawFrame(c);
  frame.pixels = randomPixels(4096, c.footprints);
  for (HandMadePixel& pixel : frame.pixels) pixel.frame = flatFrame();
  frame.ray_origin = {0, 0, -1};
  frame.ray_dx = frame.ray_dy = glm::dvec3(0);
  const ShadedPixels shaded = drawPixels(context, c, frame);
  const auto lanes = static_cast<std::size_t>(context.lanes);
  Finding finding(0);
  double different = 0, visited = 0, paid = 0;
  for (std::size_t first = 0; first < shaded.cells.size(); first += lanes) {
    std::uint32_t most = 0;
    for (std::size_t i = first; i < first + lanes; ++i) most = std::max(most, shaded.cells[i]);
    for (std::size_t i = first; i < first + lanes; ++i) {
      different += shaded.paid[i] != (most + 3) / 4 * 4;
      visited += shaded.cells[i];
      paid += shaded.paid[i];
    }
  }
  finding.add(different);
  finding.require(context.lanes == 1 || paid > visited, "idle lanes cost nothing");
  return finding;
}

// The grids that footprints of any size and shape meet: log2 of the cell size, which the finer
// level and the coarser grid's weight add up to, and the stretched box.
Finding footprintLevels(const CheckContext& context) {
  Finding finding(1);
  const glm::dvec2 stretch(0.25, 1);
  GlintMaterial glints{};
  glints.gamma = {0.25f, 1};
  glints.finest_level = -30;
  std::vector<reference::PixelFootprint> footprints;
  for (const HandMadePixel& pixel : randomPixels(5000, {1e-6, 1, 200})) {
    footprints.push_back(pixel.footprint);
    for (glm::dvec2* d : {&footprints.back().duv_dx, &footprints.back().duv_dy})
      *d = glm::dvec2(glm::vec2(*d));  // the planes hold floats
  }
  for (const int ka : {1, 16, 64}) {
    const FootprintProbe probed =
        probeFootprints(context.bench, footprints, glints, kZk16, ka, context.lanes);
    for (std::size_t i = 0; i < footprints.size(); ++i) {
      const reference::PixelFootprint& f = footprints[i];
      finding.add(std::abs(probed.fine_level[i] + probed.coarse_weight[i] -
                           std::log2(reference::cellSizeZk16(f, ka))) /
                  kFootprintLevel);
      const glm::dvec2 box = stretch * glm::max(glm::abs(f.duv_dx), glm::abs(f.duv_dy));
      finding.add(std::abs(probed.extent_u[i] / box.x - 1) / kFootprintExtent);
      finding.add(std::abs(probed.extent_v[i] / box.y - 1) / kFootprintExtent);
      finding.require(probed.coarse_weight[i] >= 0 && probed.coarse_weight[i] <= 1,
                      "weights of grids are from 0 to 1");
    }
  }
  return finding;
}

struct WidthCase {
  const char* name;
  GlintMethod method;
  bool groove, colour, cone;
};
constexpr WidthCase kWidthCases[] = {{"zk16", kZk16, false, false, false},
                                     {"zk16_groove_colour_cone", kZk16, true, true, true},
                                     {"exact", kExact, false, false, false},
                                     {"distributed", kDistributed, false, true, false},
                                     {"deliot_belcour", kDeliot, false, true, true},
                                     {"deliot_corrected", kCorrected, false, false, false},
                                     {"kemppinen", kKemppinen, false, true, true},
                                     {"published_zk16", kPublished, false, true, true}};

Finding sameGlints(const CheckContext& context, const WidthCase& c) {
  HandMadeFrame frame;
  frame.pixels = randomPixels(1003, {1e-4, 1e-2, 24});
  frame.material = simpleMaterial({0.3f, 0.2f}, {0.05f, 0.04f}, 1e6f, 1);
  frame.lights = {coneLight({-0.3, 0.2, 0.9}, c.cone ? 0.05 : 0),
                  coneLight({0.4, 0.1, 0.8}, 0, 0.3)};
  setRandomRays(frame);
  KernelConfig config;
  config.width = 1;
  config.method = c.method;
  config.groove = c.groove;
  config.glint_colour = c.colour;
  config.light_cone = c.cone;
  config.count_cells = true;
  const ShadedPixels one = shadePixels(context.bench, frame, config);
  config.width = context.lanes;
  const ShadedPixels wide = shadePixels(context.bench, frame, config);
  double different = 0;
  for (std::size_t i = 0; i < one.cells.size(); ++i)
    different += one.cells[i] != wide.cells[i] || one.limited[i] != wide.limited[i] ||
                 one.radiance[i] != wide.radiance[i];
  Finding finding(0);
  finding.add(different);
  return finding;
}

// The nearer the roughness of a groove along u is to the surface's, the longer it is: how much of
// the contrast is left between pixels 8 apart along u.
double changeAlong(const CheckContext& context, float alpha_lu) {
  const DrawCase c = {"", kZk16, {.1f, .5f}, {alpha_lu, .05f}, 1e6f, 0, true, 16, kUsual};
  HandMadeFrame frame = drawFrame(c);
  frame.ray_origin = {0, 0, -1};
  frame.ray_dx = frame.ray_dy = glm::dvec3(0);
  const double side = 1e-3;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    HandMadePixel& pixel = frame.pixels[i];
    const double pair = static_cast<double>(i / 2);
    pixel.frame = flatFrame();
    pixel.footprint.u = fixedCoordinate(0.0917 * pair + (i % 2 == 0 ? 0 : 8 * side));
    pixel.footprint.v = fixedCoordinate(0.0371 * pair);
    pixel.footprint.duv_dx = {side, 0};
    pixel.footprint.duv_dy = {0, side};
  }
  const ShadedPixels shaded = drawPixels(context, c, frame);
  double change = 0, contrast = 0, mean = 0;
  for (const glm::vec3& radiance : shaded.radiance) mean += radiance.x;
  mean /= static_cast<double>(shaded.radiance.size());
  for (std::size_t i = 0; i + 1 < shaded.radiance.size(); i += 2) {
    change += std::abs(shaded.radiance[i].x - shaded.radiance[i + 1].x);
    contrast += std::abs(shaded.radiance[i].x - mean);
  }
  return change / contrast;
}

Finding grooveLength(const CheckContext& context) {
  Finding finding(0.1);
  finding.add(changeAlong(context, .1f));
  finding.require(changeAlong(context, .01f) > 0.8, "short grooves do not end within 8 pixels");
  return finding;
}

}  // namespace

std::vector<Check> glintChecks() {
  std::vector<Check> checks;
  for (const DrawCase& c : kDrawCases)
    checks.push_back({std::string("draws/") + c.name, "share of pixels with other draws",
                      [&c](const CheckContext& context) { return drawForDraw(context, c); }});
  checks.push_back({"cells/footprint", "error in units of its bound", footprintLevels});
  checks.push_back({"cells/zk16_range", "pixels outside 8 to 64 cells", cellRange});
  checks.push_back({"cells/paid", "pixels that pay for other cells", paidCells});
  checks.push_back(
      {"cells/groove_length", "change along a long groove, of the contrast", grooveLength});
  for (const WidthCase& c : kWidthCases)
    checks.push_back({std::string("cells/same_bits_") + c.name,
                      "pixels that differ from one lane's",
                      [&c](const CheckContext& context) { return sameGlints(context, c); }});
  return checks;
}

}  // namespace glintmark
