// Draws of whole pixels: the same cells and the same draws as the double-precision reference.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"
#include "host/verify/draw_case.h"

namespace glintmark {
namespace {

constexpr auto kZk16 = GlintMethod::kZk16;
constexpr auto kExact = GlintMethod::kExact;
constexpr auto kDistributed = GlintMethod::kDistributed;
constexpr auto kDeliot = GlintMethod::kDeliotBelcour;
constexpr auto kCorrected = GlintMethod::kDeliotCorrected;
constexpr auto kKemppinen = GlintMethod::kKemppinen;
constexpr auto kPublished = GlintMethod::kPublishedZk16;
constexpr auto kChermain = GlintMethod::kChermain;
constexpr auto kChermainEven = GlintMethod::kChermainCorrected;

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
    {"chermain_sparse", kChermain, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"chermain_dense", kChermain, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"chermain_anisotropic", kChermain, {.4f, .1f}, {.1f, .05f}, 1e6f, 2, false, 16, kUsual},
    {"chermain_groove", kChermain, {.1f, .5f}, {.1f, .02f}, 1e6f, 0, true, 16, kUsual},
    {"chermain_corrected_sparse",
     kChermainEven,
     {.3f, .3f},
     {.03f, .03f},
     1e6f,
     0,
     false,
     16,
     kUsual},
    {"chermain_corrected_dense",
     kChermainEven,
     {.3f, .3f},
     {.03f, .03f},
     1e9f,
     0,
     false,
     16,
     kUsual},
    {"chermain_corrected_varied",
     kChermainEven,
     {.4f, .1f},
     {.1f, .05f},
     1e6f,
     2,
     false,
     16,
     kUsual},
    {"chermain_corrected_near", kChermainEven, {.3f, .3f}, {.2f, .2f}, 3e3f, 0, false, 16, kUsual},
    {"chermain_corrected_groove",
     kChermainEven,
     {.1f, .5f},
     {.1f, .02f},
     1e6f,
     0,
     true,
     16,
     kUsual},
    {"zk16_deep", kZk16, {.3f, .3f}, {.03f, .03f}, 0x1p42f, 0, false, 16, kDeep},
    {"zk16_deep_stretched", kZk16, {.4f, .1f}, {.02f, .05f}, 0x1p42f, 1, false, 16, kDeep},
    {"distributed_deep", kDistributed, {.3f, .3f}, {.03f, .03f}, 0x1p42f, 0, false, 16, kDeep},
    {"exact_deep", kExact, {.3f, .3f}, {.03f, .03f}, 0x1p42f, 0, false, 16, kDeep},
    {"exact_sparse", kExact, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, kUsual},
    {"exact_dense", kExact, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, kUsual},
    {"exact_varied", kExact, {.3f, .3f}, {.1f, .1f}, 1e6f, 2, false, 16, kUsual},
    {"exact_stretched", kExact, {.4f, .1f}, {.02f, .05f}, 1e6f, 1, false, 16, kUsual},
    {"exact_groove", kExact, {.1f, .5f}, {.1f, .02f}, 1e6f, 1, true, 16, kUsual},
    {"exact_grazing", kExact, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, {1e-4, 1e-3, 500}}};

// How many cells a pixel's count may be off where some lie on the border of what counts.
double borderCells(GlintMethod method) {
  return method == kExact || method == kChermain || method == kChermainEven ? 2 : 0;
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
  options.deep_uv = isDeep(c);

  const double most_flipped = flippedShare(c.method);
  Finding finding(most_flipped);
  double different_counts = 0, flipped = 0, sum = 0, sum_reference = 0;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const reference::PixelResult expected =
        reference::evaluatePixel(referencePixel(frame, frame.pixels[i]),
                                 referenceGlints(frame.material, c.groove), lights, options);
    // Where a placed microdetail or a cell is on a border, floats decide.
    if (c.method == kDistributed && expected.tied) continue;
    const double difference = std::abs(static_cast<double>(shaded.cells[i]) - expected.cells);
    finding.require(
        difference <= borderCells(c.method),
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

}  // namespace

std::vector<Check> glintChecks() {
  std::vector<Check> checks;
  for (const DrawCase& c : kDrawCases)
    checks.push_back({std::string("draws/") + c.name, "share of pixels with other draws",
                      [&c](const CheckContext& context) { return drawForDraw(context, c); }});
  return checks;
}

}  // namespace glintmark
