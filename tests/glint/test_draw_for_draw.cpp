// The kernel against the double-precision reference, pixel by pixel: the same cells, the same
// draws, the same radiance.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/glint/pixel_harness.h"
#include "tests/glint/random_pixels.h"
#include "tests/tolerances.h"

namespace glintmark {
namespace {

struct DrawCase {
  const char* name;
  GlintMethod method;
  float2 alpha_g, alpha_l;
  float density;
  float size_variation;
  bool groove;
  int ka;
  double least_size, most_size, most_aspect;
};

void PrintTo(const DrawCase& c, std::ostream* out) {
  *out << c.name;
}

class DrawForDraw : public testing::TestWithParam<DrawCase> {};

TEST_P(DrawForDraw, KernelAgreesWithTheReference) {
  const DrawCase& c = GetParam();
  HandMadeFrame frame;
  frame.material = simpleMaterial(c.alpha_g, c.alpha_l, c.density, c.size_variation);
  frame.pixels = randomPixels(2000, {c.least_size, c.most_size, c.most_aspect});
  frame.lights = {coneLight({-0.3, 0.2, 0.9})};
  setRandomRays(frame);

  KernelConfig config;
  config.width = 16;
  config.method = c.method;
  config.ka = c.ka;
  config.groove = c.groove;
  config.size_variation = c.size_variation > 0;
  config.count_cells = true;
  const ShadedPixels shaded = shadePixels(frame, config);
  KernelConfig smooth_config;
  smooth_config.width = 16;
  smooth_config.glint = false;
  const ShadedPixels smooth = shadePixels(frame, smooth_config);

  const reference::Glints glints = referenceGlints(frame.material, c.groove);
  const std::vector<reference::PointLight> lights = referenceLights(frame);
  reference::GlintMethodOptions options;
  options.exact = c.method == GlintMethod::kExact;
  options.ka = c.ka;
  options.stretch = deviceStretch(frame.material);

  int different_counts = 0, different_limits = 0, flipped = 0, limited = 0, tied = 0;
  double worst = 0, sum = 0, sum_reference = 0;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const reference::PixelResult expected =
        reference::evaluatePixel(referencePixel(frame, frame.pixels[i]), glints, lights, options);
    const int difference =
        std::abs(static_cast<int>(shaded.cells[i]) - static_cast<int>(expected.cells));
    ASSERT_LE(difference, options.exact ? 2 : 0) << i;
    different_counts += difference != 0;
    different_limits += shaded.limited[i] != expected.limited;
    limited += expected.limited;
    if (expected.cells == 0) continue;
    if (expected.tied) {
      ++tied;
      continue;
    }
    // Relative to the smooth lobe, so that the approximations in the lobe stay out of it.
    const double got = shaded.radiance[i].x / smooth.radiance[i].x;
    const double want = expected.radiance.x / expected.smooth.x;
    ASSERT_TRUE(std::isfinite(got) && got >= 0) << i;
    const double error = std::abs(got - want) / std::max(want, 1.0);
    if (error > kShareTolerance + 2 * expected.rounding)
      ++flipped;
    else
      worst = std::max(worst, error);
    sum += got;
    sum_reference += want;
  }
  std::printf(
      "%-24s limited %d, tied %d, flipped %d of %zu, worst other %.2g, mean %.6g reference %.6g\n",
      c.name, limited, tied, flipped, frame.pixels.size(), worst,
      sum / static_cast<double>(frame.pixels.size()),
      sum_reference / static_cast<double>(frame.pixels.size()));
  EXPECT_LE(different_counts, kThresholdCountShare * static_cast<double>(frame.pixels.size()));
  EXPECT_EQ(different_limits, 0);
  EXPECT_LE(flipped, kFlippedPixelShare * static_cast<double>(frame.pixels.size()));
  EXPECT_NEAR(sum / sum_reference, 1.0, kFlippedPixelShare);
}

constexpr auto kZk16 = GlintMethod::kZk16;
constexpr auto kExact = GlintMethod::kExact;

INSTANTIATE_TEST_SUITE_P(
    Cases, DrawForDraw,
    testing::Values(
        DrawCase{
            "zk16_sparse", kZk16, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, 1e-4, 1e-2, 20},
        DrawCase{"zk16_dense", kZk16, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, 1e-4, 1e-2, 20},
        DrawCase{"zk16_varied", kZk16, {.3f, .3f}, {.1f, .1f}, 1e6f, 2, false, 16, 1e-4, 1e-2, 20},
        DrawCase{
            "zk16_stretched", kZk16, {.4f, .1f}, {.02f, .05f}, 1e6f, 1, false, 16, 1e-4, 1e-2, 20},
        DrawCase{"zk16_groove", kZk16, {.1f, .5f}, {.1f, .02f}, 1e6f, 1, true, 16, 1e-4, 1e-2, 20},
        DrawCase{"zk16_ka4", kZk16, {.3f, .3f}, {.03f, .03f}, 1e7f, 0, false, 4, 1e-4, 1e-2, 64},
        DrawCase{"zk16_ka1", kZk16, {.3f, .3f}, {.03f, .03f}, 1e7f, 0, false, 1, 1e-4, 1e-2, 64},
        DrawCase{"zk16_ka64", kZk16, {.3f, .3f}, {.03f, .03f}, 1e7f, 0, false, 64, 1e-4, 1e-2, 100},
        DrawCase{"zk16_wide_lobe",
                 kZk16,
                 {.3f, .3f},
                 {.299f, .299f},
                 1e6f,
                 1,
                 false,
                 16,
                 1e-4,
                 1e-2,
                 20},
        DrawCase{
            "exact_sparse", kExact, {.3f, .3f}, {.03f, .03f}, 1e6f, 0, false, 16, 1e-4, 1e-2, 20},
        DrawCase{
            "exact_dense", kExact, {.3f, .3f}, {.03f, .03f}, 1e9f, 0, false, 16, 1e-4, 1e-2, 20},
        DrawCase{
            "exact_varied", kExact, {.3f, .3f}, {.1f, .1f}, 1e6f, 2, false, 16, 1e-4, 1e-2, 20},
        DrawCase{"exact_stretched",
                 kExact,
                 {.4f, .1f},
                 {.02f, .05f},
                 1e6f,
                 1,
                 false,
                 16,
                 1e-4,
                 1e-2,
                 20},
        DrawCase{
            "exact_groove", kExact, {.1f, .5f}, {.1f, .02f}, 1e6f, 1, true, 16, 1e-4, 1e-2, 20},
        DrawCase{"exact_grazing",
                 kExact,
                 {.3f, .3f},
                 {.03f, .03f},
                 1e6f,
                 0,
                 false,
                 16,
                 1e-4,
                 1e-3,
                 500}),
    [](const auto& param_info) { return std::string(param_info.param.name); });

}  // namespace
}  // namespace glintmark
