// Knobs that trade accuracy for time: each compiles and stays close to what it stands for, and the
// settings that spell out a default give its bits.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "host/filter/normal_map_generators.h"
#include "host/fit/ltc_table.h"
#include "host/frame/frame_renderer.h"
#include "tests/frame/frame_test.h"

namespace glintmark {
namespace {

// Four lanes: compiled fast, and vectors all the same.
ShadingOptions fewLanes() {
  ShadingOptions options = smallOptions();
  options.lanes = 4;
  return options;
}

Image radianceAt(const Scene& scene, const ShadingOptions& options, double angle_deg = 20) {
  FrameRenderer renderer(device(), scene, lookingDown(angle_deg), options, 2);
  renderer.prepare();
  renderer.shade();
  return renderer.readRadiance();
}

double meanRed(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) sum += image.pixels[i];
  return sum / (static_cast<double>(image.pixels.size()) / 4);
}

// Mean absolute difference over the mean of `b`.
double relativeDifference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) sum += std::abs(a.pixels[i] - b.pixels[i]);
  return sum / (static_cast<double>(a.pixels.size()) / 4) / meanRed(b);
}

// Some hundred microdetails under a pixel, of which a few reflect: neither rare nor a crowd.
Scene sparseScene() {
  Scene scene = floorScene();
  scene.materials[0].params.glints.density = 3e5f;
  return scene;
}

Image glints(BinomialForm form, int terms = 16, GlintMethod method = GlintMethod::kZk16) {
  ShadingOptions options = fewLanes();
  options.method = method;
  options.binomial = form;
  options.binomial_terms = terms;
  return radianceAt(sparseScene(), options);
}

Image smooth() {
  ShadingOptions options = fewLanes();
  options.glints = false;
  return radianceAt(sparseScene(), options);
}

TEST(AccuracyKnobs, SpelledOutDefaultsGiveTheSameBits) {
  EXPECT_EQ(glints(BinomialForm::kCapped, 16).pixels, glints(BinomialForm::kOfMethod).pixels);
  EXPECT_EQ(glints(BinomialForm::kExact, 16, GlintMethod::kExact).pixels,
            glints(BinomialForm::kOfMethod, 16, GlintMethod::kExact).pixels);
}

TEST(AccuracyKnobs, ExpectedValuesAreTheSmoothLobe) {
  // Cells hold whole numbers of microdetails, drawn around their mean; the lobe of a cell is that
  // of its half-vector cell, as wide as the micro roughness: a tenth of the lobe's width.
  const Image mean = smooth();
  EXPECT_LT(relativeDifference(glints(BinomialForm::kExpected), mean), 0.1);
  EXPECT_GT(relativeDifference(glints(BinomialForm::kOfMethod), mean), 0.15);
}

TEST(AccuracyKnobs, MoreTermsComeCloserToTheExactDraw) {
  const Image exact = glints(BinomialForm::kExact);
  const double two = relativeDifference(glints(BinomialForm::kCapped, 2), exact);
  const double eight = relativeDifference(glints(BinomialForm::kCapped, 8), exact);
  const double many = relativeDifference(glints(BinomialForm::kCapped, 64), exact);
  EXPECT_GT(two, eight);
  EXPECT_GE(eight, many);
  EXPECT_LT(many, 0.01);
  // A Gaussian of a mean below one is far off.
  EXPECT_GT(relativeDifference(glints(BinomialForm::kGaussian), exact), many);
}

TEST(AccuracyKnobs, OneGridKeepsTheMean) {
  for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact}) {
    ShadingOptions options = fewLanes();
    options.method = method;
    const Image two = radianceAt(floorScene(), options);
    options.grids = 1;
    const Image one = radianceAt(floorScene(), options);
    // 9216 pixels, each with a standard deviation of one to two times its mean: 2 %.
    EXPECT_NEAR(meanRed(one) / meanRed(two), 1, 0.08);
    EXPECT_NE(one.pixels, two.pixels);
  }
}

TEST(AccuracyKnobs, TheDevicesMathsShowTheSamePicture) {
  ShadingOptions options = fewLanes();
  const Image own = radianceAt(floorScene(), options);
  for (const Maths maths : {Maths::kNative, Maths::kPrecise}) {
    options.maths = maths;
    // A draw on the edge may fall the other way in a pixel here and there.
    EXPECT_LT(relativeDifference(radianceAt(floorScene(), options), own), 0.01);
  }
}

Scene areaLightScene() {
  Scene scene = floorScene();
  scene.lights.clear();
  scene.materials[0].has_glints = false;
  scene.materials[0].ggx = true;
  AreaLight lamp;
  lamp.vertices = {{-1, 0.3, -2.5}, {1, 0.3, -2.5}, {1, 1.8, -2.5}, {-1, 1.8, -2.5}};
  lamp.radiance = {4, 4, 4};
  lamp.two_sided = true;
  scene.area_lights = {lamp};
  return scene;
}

TEST(AccuracyKnobs, EdgeIntegralsAgree) {
  ShadingOptions options = fewLanes();
  const Image fit = radianceAt(areaLightScene(), options);
  ASSERT_GT(meanRed(fit), 0);
  options.edges = EdgeIntegral::kAcos;
  EXPECT_LT(relativeDifference(radianceAt(areaLightScene(), options), fit), 1e-3);
  options.edges = EdgeIntegral::kRational;
  EXPECT_LT(relativeDifference(radianceAt(areaLightScene(), options), fit), 1e-2);
}

TEST(AccuracyKnobs, RoundLobesAreForAnisotropicMaterialsOnly) {
  ShadingOptions options = fewLanes(), round = options;
  round.round_lobes = true;
  Scene scene = areaLightScene();
  EXPECT_EQ(radianceAt(scene, round).pixels, radianceAt(scene, options).pixels);
  scene.materials[0].params.surface.alpha_g = {0.5f, 0.05f};
  const Image stretched = radianceAt(scene, options);
  EXPECT_GT(relativeDifference(radianceAt(scene, round), stretched), 0.1);
  // Of the same surface with its axes named the other way round nothing is the same.
  scene.materials[0].params.surface.alpha_g = {0.05f, 0.5f};
  EXPECT_GT(relativeDifference(radianceAt(scene, options), stretched), 0.1);
}

TEST(AccuracyKnobs, TablesOfCosinesInPlaceOfTheShippedOne) {
  ShadingOptions options = fewLanes();
  const Image shipped = radianceAt(areaLightScene(), options);
  options.ltc_table = std::make_shared<const LtcTable>(shippedLtcTable(reference::Ndf::kGgx));
  EXPECT_EQ(radianceAt(areaLightScene(), options).pixels, shipped.pixels);
  options.ltc_table = nullptr;
  options.ltc_half = true;
  const Image half = radianceAt(areaLightScene(), options);
  EXPECT_LT(relativeDifference(half, shipped), 1e-2);  // halves have 11 bits
  EXPECT_NE(half.pixels, shipped.pixels);
}

TEST(AccuracyKnobs, IterationsOfTheFitReachTheMixtures) {
  Scene scene = floorScene();
  scene.materials[0].has_glints = false;
  scene.materials[0].normal_map = NormalMapSource{
      std::make_shared<const NormalMap>(generateNormalMap({.kind = "disk", .size_px = 32})), 4};
  ShadingOptions options = fewLanes();
  const Image standard = radianceAt(scene, options);
  options.mixture_iterations = MixtureOptions{}.max_iterations;
  EXPECT_EQ(radianceAt(scene, options).pixels, standard.pixels);
  options.mixture_iterations = 1;
  EXPECT_NE(radianceAt(scene, options).pixels, standard.pixels);
}

}  // namespace
}  // namespace glintmark
