// Whole frames under area lights: distance, switches, ground truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/filter/normal_map_generators.h"
#include "host/frame/effects.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/ground_truth.h"
#include "host/harness/area_light_harness.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/small_scenes.h"
#include "host/report/metrics.h"
#include "host/scene/load_scene.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

constexpr int kWidth_px = 48, kHeight_px = 32;
// Mean and truth are compared over a frame whose light is even, so that pixels average.
constexpr int kTruthSpp = 512;

// A floor of bumps that is lit from the side by a lamp as long as the floor.
Scene bumpyScene(bool mapped) {
  Scene scene;
  Material material;
  material.name = "metal";
  material.has_glints = false;
  material.ggx = true;
  material.params.surface.alpha_g = material.params.glints.alpha_l = {0.05f, 0.05f};
  material.params.surface.intensity = 1;
  material.params.surface.f0 = {1, 1, 1, 0};
  if (mapped) {
    NormalMapRecipe recipe;
    recipe.kind = "bumps";
    recipe.size_px = 128;
    recipe.height_scale = 0.6;
    material.normal_map =
        NormalMapSource{std::make_shared<const NormalMap>(generateNormalMap(recipe))};
  }
  scene.materials = {material};
  addFloor(scene, -8, 8, 0);
  AreaLight lamp;
  lamp.vertices = rectangleVertices({0, 6, -40}, {0, 0, 1}, {0, 1, 0}, {200, 10});
  scene.area_lights = {lamp};
  return scene;
}

ShadingOptions smallFrame() {
  ShadingOptions options;
  options.width_px = kWidth_px;
  options.height_px = kHeight_px;
  options.lanes = 16;
  return options;
}

Image shaded(const Scene& scene, const View& view, const ShadingOptions& options) {
  FrameRenderer renderer(testBench().device, scene, view, options, 2);
  renderer.prepare();
  renderer.shade();
  return renderer.readRadiance();
}

double meanOf(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) sum += image.pixels[i];
  return sum / (static_cast<double>(image.pixels.size()) / 4);
}

// The texels under a pixel grow from 2 to 512 as uvs are scaled up; the light stays as it is.
TEST(Minification, MultiScaleKeepsItsErrorAndTheOriginalDoesNot) {
  std::vector<double> original_error, exact_error;
  for (const double texels_per_px : {2.0, 16.0, 128.0, 512.0}) {
    Scene scene = bumpyScene(true);
    const View view = lookingDown(30, 3);
    // A pixel in the middle is 3 * 2 tan(10 deg) / kHeight_px wide.
    const double pixel = 3 * 2 * std::tan(0.1745) / kHeight_px;
    for (glm::dvec2& uv : scene.mesh.uvs) uv *= texels_per_px / 128 / pixel;
    const TruthImages truth =
        renderTruth(testBench().device, scene, view, smallFrame(), kTruthSpp, {}, 2);
    const double exact_mean = meanOf(truth.mean);
    ASSERT_GT(exact_mean, 0.01);
    ShadingOptions options = smallFrame();
    options.ltc_method = LtcMethod::kOriginal;
    original_error.push_back(std::abs(meanOf(shaded(scene, view, options)) / exact_mean - 1));
    options.ltc_method = LtcMethod::kExact;
    exact_error.push_back(std::abs(meanOf(shaded(scene, view, options)) / exact_mean - 1));
  }
  for (std::size_t i = 1; i < exact_error.size(); ++i)
    EXPECT_LT(exact_error[i], exact_error[0] + 0.15) << "step " << i;
  EXPECT_GT(original_error.back(), 2 * exact_error.back());
  EXPECT_GT(original_error.back(), original_error.front());
}

// Mixtures see what the mean's length cannot tell.
TEST(AreaLightFrame, MixturesAreCloserThanOneLobe) {
  const Scene scene = bumpyScene(true);
  const View view = lookingDown(30, 12);
  const TruthImages truth =
      renderTruth(testBench().device, scene, view, smallFrame(), kTruthSpp, {}, 2);
  ShadingOptions options = smallFrame();
  const auto distance = [&](LtcMethod method) {
    options.ltc_method = method;
    const Image image = shaded(scene, view, options);
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size() / 4; ++i)
      sum += std::abs(image.pixels[4 * i] - truth.mean.pixels[4 * i]);
    return sum;
  };
  const double one_lobe = distance(LtcMethod::kExact);
  EXPECT_LT(distance(LtcMethod::kMixture), one_lobe);
  EXPECT_NEAR(meanOf(shaded(scene, view, options)) / meanOf(truth.mean), 1, 0.15);
}

// How its lobes are shared out among a texel's normals shows under narrow lobes: four steps a
// sweep, as for cones, leave more.
TEST(AreaLightFrame, ClothIsCloserByAFitOfFewSteps) {
  SceneRequest request;
  request.scene = "area_cloth";
  const Scene scene = loadScene(request);
  ShadingOptions options = smallFrame();
  options.width_px = 320;
  options.height_px = 180;
  options.ltc_method = LtcMethod::kMixture;
  const TruthImages truth =
      renderTruth(testBench().device, scene, scene.view("near"), options, kTruthSpp, {}, 2);
  const auto error = [&] { return relMse(shaded(scene, scene.view("near"), options), truth.mean); };
  const double few_steps = error();
  EXPECT_LT(few_steps, 0.052);  // 0.046, and what the truth's samples leave
  options.mixture_iterations = 4;
  EXPECT_LT(few_steps, 0.97 * error());
}

TEST(AreaLightFrame, SmoothFloorIsTheMonteCarloTruth) {
  const Scene scene = bumpyScene(false);
  const View view = lookingDown(30);
  const TruthImages truth =
      renderTruth(testBench().device, scene, view, smallFrame(), kTruthSpp, {}, 2);
  const Image image = shaded(scene, view, smallFrame());
  EXPECT_NEAR(meanOf(image) / meanOf(truth.mean), 1, 0.03) << "the fit's error";
}

// The standard error that a truth states covers what it is off, within a factor of 2 either way.
void expectHonestError(const TruthImages& truth, const Image& right) {
  double stated = 0, actual = 0;
  for (std::size_t i = 0; i < truth.mean.pixels.size(); i += 4) {
    stated += std::pow(truth.standard_error.pixels[i / 4 * 3], 2);
    actual += std::pow(truth.mean.pixels[i] - right.pixels[i], 2);
  }
  EXPECT_GT(std::sqrt(stated / actual), 0.5);
  EXPECT_LT(std::sqrt(stated / actual), 2);
}

TEST(AreaLightFrame, StandardErrorIsTheDistanceToAFinerTruth) {
  const Scene scene = bumpyScene(true);
  const View view = lookingDown(30, 3);
  const auto render = [&](int spp) {
    return renderTruth(testBench().device, scene, view, smallFrame(), spp, {}, 2);
  };
  const TruthImages fine = render(8192);
  for (const int spp : {32, 256}) expectHonestError(render(spp), fine.mean);
}

// Of a diffuse floor the frame is exact.
TEST(AreaLightFrame, DiffuseIsTheMonteCarloTruthWithinItsStandardError) {
  Scene scene = bumpyScene(false);
  scene.materials[0].params.surface.intensity = 0;
  scene.materials[0].params.surface.albedo = {0.5f, 0.25f, 0.125f, 0};
  scene.area_lights[0].vertices = rectangleVertices({0, 2, -2}, {0, -1, 1}, {0, 1, 0}, {2, 1});
  const View view = lookingDown(60);
  const TruthImages truth =
      renderTruth(testBench().device, scene, view, smallFrame(), kTruthSpp, {}, 2);
  const Image image = shaded(scene, view, smallFrame());
  expectHonestError(truth, image);
  EXPECT_NEAR(meanOf(image) / meanOf(truth.mean), 1, 0.002);
}

TEST(AreaLightFrame, ScenesDecideTheSwitches) {
  Scene scene = bumpyScene(true);
  KernelConfig config = configFor(scene.materials[0], scene, smallFrame(), 16);
  EXPECT_TRUE(config.ltc && config.ggx && config.normal_map);
  EXPECT_FALSE(config.light_texture || config.light_shapes || config.clipless || config.diffuse);
  EXPECT_EQ(config.light_vertices, 4);
  EXPECT_EQ(config.ltc_method, LtcMethod::kExact);
  EXPECT_TRUE(config.planes.has(Plane::kDepth));
  ShadingOptions options = smallFrame();
  options.ltc_method = LtcMethod::kMixture;
  const KernelConfig mixture = configFor(scene.materials[0], scene, options, 16);
  EXPECT_EQ(mixture.ltc_method, LtcMethod::kMixture);
  EXPECT_EQ(mixture.normal_method, NormalMethod::kGmm);
  EXPECT_EQ(mixture.lobes, scene.materials[0].normal_map->lobes);
  scene.area_lights[0].texture = paintLightTexture("checker", 16);
  EXPECT_TRUE(configFor(scene.materials[0], scene, smallFrame(), 16).light_texture);
  scene.area_lights.push_back(scene.area_lights[0]);
  scene.area_lights[1].shape = LightShape::kSphere;
  scene.area_lights[1].vertices.clear();
  EXPECT_TRUE(configFor(scene.materials[0], scene, smallFrame(), 16).light_shapes);
  scene.area_lights.clear();
  config = configFor(scene.materials[0], scene, smallFrame(), 16);
  EXPECT_FALSE(config.ltc || config.light_texture);
  EXPECT_TRUE(config.ggx) << "the material's lobe, whatever the lights";
  EXPECT_FALSE(config.planes.has(Plane::kDepth));
}

TEST(AreaLightFrame, LanesAgreeBitForBitWithMapsAndPictures) {
  Scene scene = bumpyScene(true);
  scene.area_lights[0].texture = paintLightTexture("panes", 64);
  scene.materials[0].params.surface.albedo = {0.2f, 0.2f, 0.2f, 0};
  const View view = lookingDown(30);
  ShadingOptions options = smallFrame();
  const Image wide = shaded(scene, view, options);
  for (const float value : wide.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0);
  options.lanes = 1;
  EXPECT_EQ(shaded(scene, view, options).pixels, wide.pixels);
}

TEST(AreaLightFrame, PictureOfOneColourIsThatColour) {
  Scene scene = bumpyScene(false);
  const View view = lookingDown(30);
  const Image plain = shaded(scene, view, smallFrame());
  scene.area_lights[0].texture = Image(37, 21, 3);
  std::ranges::fill(scene.area_lights[0].texture.pixels, 0.5f);
  const Image textured = shaded(scene, view, smallFrame());
  for (std::size_t i = 0; i < plain.pixels.size(); i += 4)
    EXPECT_NEAR(textured.pixels[i], 0.5f * plain.pixels[i], 1e-5f + 1e-4f * plain.pixels[i]);
}

}  // namespace
}  // namespace glintmark
