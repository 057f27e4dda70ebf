// FrameRenderer from a scene to images and counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/frame/effects.h"
#include "host/frame/frame_renderer.h"
#include "tests/frame/frame_test.h"

namespace glintmark {
namespace {

Image radianceOf(const Scene& scene, const View& view, const ShadingOptions& options) {
  FrameRenderer renderer(device(), scene, view, options, 2);
  renderer.prepare();
  renderer.shade();
  return renderer.readRadiance();
}

double meanOf(const Image& image, std::size_t channel = 0) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += 4) sum += image.pixels[i];
  return sum / (static_cast<double>(image.pixels.size()) / 4);
}

TEST(FrameRenderer, GlintsAverageToTheSmoothLobe) {
  const Scene scene = floorScene();
  for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact})
    for (const double angle_deg : {90.0, 10.0}) {
      ShadingOptions options = smallOptions();
      options.method = method;
      const Image glints = radianceOf(scene, lookingDown(angle_deg), options);
      options.glints = false;
      const Image smooth = radianceOf(scene, lookingDown(angle_deg), options);
      // 14400 pixels, each with a standard deviation of about its mean: 1 %.
      for (const std::size_t channel : {0u, 1u, 2u})
        EXPECT_NEAR(meanOf(glints, channel) / meanOf(smooth, channel), 1, 0.04) << angle_deg;
    }
}

TEST(FrameRenderer, GlintOnlySceneTakesAtMost64BytesPerPixel) {
  const Scene scene = floorScene();
  FrameRenderer renderer(device(), scene, lookingDown(90), smallOptions(), 2);
  renderer.prepare();
  ASSERT_EQ(renderer.planes().covered_px, 160u * 90u) << "the floor fills the screen";
  EXPECT_LE(renderer.bufferBytes(), 64u * 160u * 90u);
}

TEST(FrameRenderer, SmoothShadingAllocatesNoPlaneOfGlints) {
  const Scene scene = floorScene();
  ShadingOptions options = smallOptions();
  options.glints = false;
  FrameRenderer renderer(device(), scene, lookingDown(90), options, 2);
  renderer.prepare();
  EXPECT_EQ(renderer.planes().mask, (PlaneMask{Plane::kPixel, Plane::kFrame0, Plane::kFrame1}));
  // Three planes and three channels of radiance.
  EXPECT_EQ(renderer.bufferBytes(), 6u * 4u * renderer.planes().stride);
  for (const KernelConfig& config : renderer.configs()) {
    EXPECT_FALSE(config.glint);
    EXPECT_FALSE(config.count_cells);
  }
}

TEST(FrameRenderer, ScenesDecideTheSwitches) {
  Scene scene = floorScene();
  ShadingOptions options = smallOptions();
  KernelConfig config = configFor(scene.materials[0], scene, options, 16);
  EXPECT_TRUE(config.glint);
  EXPECT_FALSE(config.groove || config.glint_colour || config.size_variation || config.light_cone ||
               config.diffuse || config.count_cells);
  scene.lights[0].direction.w = 0.01f;
  scene.materials[0].has_grooves = scene.materials[0].has_colour = true;
  scene.materials[0].params.glints.size_variation = 1;
  scene.materials[0].params.surface.albedo.y = 0.1f;
  options.count_cells = true;
  config = configFor(scene.materials[0], scene, options, 16);
  EXPECT_TRUE(config.groove && config.glint_colour && config.size_variation && config.light_cone &&
              config.diffuse && config.count_cells);
}

// 2^20 microdetails a uv: cells of 2^-10, of which 2^32 are 2^22 units of uv.
TEST(FrameRenderer, CellsAreToldApartBeyond32BitsWhereUvAndDensityAsk) {
  Scene scene = floorScene();
  scene.materials[0].params.glints.density = 0x1p20f;
  ShadingOptions options = smallOptions();
  const auto isDeep = [&] { return configFor(scene.materials[0], scene, options, 16).deep_uv; };
  EXPECT_FALSE(isDeep());
  for (const glm::dvec2 far : {glm::dvec2(0x1p22, 0), glm::dvec2(0, -0x1p22)}) {
    scene.mesh.uvs.back() = far;
    options.method = GlintMethod::kZk16;
    EXPECT_TRUE(isDeep());
    options.method = GlintMethod::kKemppinen;  // its cells recur
    EXPECT_FALSE(isDeep());
  }
  options.method = GlintMethod::kDistributed;
  EXPECT_TRUE(isDeep());
  scene.materials[0].params.glints.density = 0x1p10f;
  EXPECT_FALSE(isDeep());
  scene.mesh.uvs.back() = {1, 1};
  scene.materials[0].params.glints.density = 0x1p50f;
  EXPECT_TRUE(isDeep());
  options.glints = false;
  EXPECT_FALSE(isDeep());
}

TEST(FrameRenderer, HeatmapIsWithin8And64AndMatchesItsSummary) {
  const Scene scene = floorScene();
  for (const double angle_deg : {90.0, 10.0, 2.0}) {
    ShadingOptions options = smallOptions();
    options.count_cells = true;
    FrameRenderer renderer(device(), scene, lookingDown(angle_deg), options, 2);
    renderer.prepare();
    renderer.shade();
    const Image cells = renderer.readCells();
    const CellCounts counts = renderer.cellCounts();
    double sum = 0;
    std::size_t pixels = 0;
    for (const float count : cells.pixels) {
      EXPECT_TRUE(count == -1 || count == 0 || (count >= 8 && count <= 64)) << count;
      if (count <= 0) continue;
      sum += count;
      ++pixels;
    }
    EXPECT_EQ(counts.glint_px, pixels);
    EXPECT_NEAR(counts.mean, sum / static_cast<double>(pixels), 1e-9);
    EXPECT_GE(counts.min, 8u);
    EXPECT_LE(counts.max, 64u);
    if (angle_deg == 90) {
      EXPECT_LT(counts.mean, 12) << "square footprints";
      EXPECT_EQ(counts.guard_hits, 0u);
    }
    if (angle_deg == 2) {
      EXPECT_GT(counts.mean, 40) << "beyond the 16 : 1 limit";
      EXPECT_GT(counts.guard_hits, 0u);
    }
  }
}

TEST(FrameRenderer, CountingAndLanesKeepTheImage) {
  const Scene scene = floorScene();
  const View view = lookingDown(20);
  ShadingOptions options = smallOptions();
  const Image image = radianceOf(scene, view, options);
  options.count_cells = true;
  EXPECT_EQ(image.pixels, radianceOf(scene, view, options).pixels);
  options.count_cells = false;
  options.lanes = 1;
  EXPECT_EQ(image.pixels, radianceOf(scene, view, options).pixels);
}

TEST(FrameRenderer, CellsThatWereNotCountedAreAnError) {
  const Scene scene = floorScene();
  FrameRenderer renderer(device(), scene, lookingDown(90), smallOptions(), 2);
  renderer.prepare();
  renderer.shade();
  EXPECT_THROW(renderer.readCells(), Error);
  EXPECT_THROW(renderer.cellCounts(), Error);
}

TEST(FrameRenderer, EachMaterialHasItsOwnKernel) {
  Scene scene = floorScene();
  scene.mesh = {};
  addFloor(scene, -8, 0, 0);
  addFloor(scene, 0, 8, 1);
  Material paint;
  paint.name = "paint";
  paint.has_glints = false;
  paint.params.surface.alpha_g = paint.params.glints.alpha_l = {0.3f, 0.3f};
  paint.params.surface.f0 = {0.04f, 0.04f, 0.04f, 0};
  paint.params.surface.albedo = {0.5f, 0.25f, 0, 0};
  paint.params.surface.intensity = 0;
  scene.materials.push_back(paint);
  ShadingOptions options = smallOptions();
  options.count_cells = true;
  FrameRenderer renderer(device(), scene, lookingDown(90), options, 2);
  renderer.prepare();
  renderer.shade();
  ASSERT_EQ(renderer.configs().size(), 2u);
  EXPECT_TRUE(renderer.configs()[0].glint);
  EXPECT_FALSE(renderer.configs()[1].glint);
  const Image image = renderer.readRadiance(), cells = renderer.readCells();
  // The painted half: albedo / pi times the irradiance of 3 at cos 0.8.
  const float* const painted = &image.pixels[4 * (45 * 160 + 120)];
  EXPECT_NEAR(painted[0], 0.5 / M_PI * 3 * 0.8, 1e-5);
  EXPECT_NEAR(painted[1], 0.25 / M_PI * 3 * 0.8, 1e-5);
  EXPECT_EQ(painted[2], 0);
  EXPECT_EQ(cells.pixels[45 * 160 + 120], -1);
  EXPECT_GE(cells.pixels[45 * 160 + 40], 8);
}

TEST(FrameRenderer, EmptyFrame) {
  const Scene scene = floorScene();
  View away;
  away.eye = {0, 1, 0};
  away.target = {0, 2, 0};
  away.up = {0, 0, 1};
  ShadingOptions options = smallOptions();
  options.count_cells = true;
  FrameRenderer refused(device(), scene, away, options, 2);
  EXPECT_THROW(refused.prepare(), Error);
  options.may_show_nothing = true;
  FrameRenderer renderer(device(), scene, away, options, 2);
  renderer.prepare();
  renderer.shade();
  for (const float value : renderer.readRadiance().pixels) EXPECT_EQ(value, 0);
  for (const float count : renderer.readCells().pixels) EXPECT_EQ(count, -1);
  EXPECT_EQ(renderer.cellCounts().glint_px, 0u);
}

TEST(FrameRenderer, OnePixelFrame) {
  const Scene scene = floorScene();
  ShadingOptions options = smallOptions();
  options.width_px = options.height_px = 1;
  const Image image = radianceOf(scene, lookingDown(90), options);
  ASSERT_EQ(image.pixels.size(), 4u);
  EXPECT_TRUE(std::isfinite(image.pixels[0]) && image.pixels[0] >= 0);
  EXPECT_EQ(image.pixels[3], 1);
}

TEST(FrameRenderer, FarAndGrazingPixelsStayFinite) {
  const Scene scene = floorScene();
  for (const double angle_deg : {1.0, 0.1}) {
    ShadingOptions options = smallOptions();
    for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact}) {
      options.method = method;
      for (const float value : radianceOf(scene, lookingDown(angle_deg), options).pixels)
        ASSERT_TRUE(std::isfinite(value) && value >= 0);
    }
  }
}

TEST(FrameRenderer, SubPixelMotionIsNoSceneCut) {
  // The camera moves by a quarter of a pixel: the image of dense glints changes far less than
  // between two places of the floor.
  Scene scene = floorScene();
  scene.materials[0].params.glints.density = 1e6f;
  const View still = lookingDown(45);
  const double pixel = 2 * std::tan(10 * M_PI / 180) * 3 / 90;
  const auto moved = [&](double pixels) {
    View view = still;
    view.eye.x += pixels * pixel;
    view.target.x += pixels * pixel;
    return radianceOf(scene, view, smallOptions());
  };
  const Image a = moved(0), b = moved(0.25), c = moved(31.5);
  const auto difference = [&](const Image& x, const Image& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.pixels.size(); i += 4)
      sum += (x.pixels[i] - y.pixels[i]) * (x.pixels[i] - y.pixels[i]);
    return sum;
  };
  EXPECT_LT(difference(a, b), 0.3 * difference(a, c));
}

}  // namespace
}  // namespace glintmark
