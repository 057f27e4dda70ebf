// The truth of a relief: against the flat truth where it is flat, against what one side of a groove
// is where that side alone is seen or lit, and what it says of LEADR.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "host/core/angles.h"
#include "host/core/error.h"
#include "host/filter/normal_map_generators.h"
#include "host/frame/displaced_truth.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/ground_truth.h"
#include "host/harness/small_scenes.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

constexpr int kReliefSize_px = 16;
constexpr int kRidge_px = 128;  // texels from ridge to ridge
constexpr int kMap_px = 256;
constexpr double kSlope = 1;

// Ridges along v: sides of 45 degrees that face u and the other way.
NormalMap ridges() {
  Image heights(kMap_px, kMap_px, 1);
  for (int y = 0; y < kMap_px; ++y)
    for (int x = 0; x < kMap_px; ++x) {
      const double phase = std::fmod(x + 0.5, kRidge_px);
      heights.at(x, y)[0] =
          static_cast<float>(kSlope / kMap_px * std::min(phase, kRidge_px - phase));
    }
  return normalsFromHeights(heights, 1, "ridges");
}

// A Lambertian floor under one light, whose eye is towards u at 35 degrees: lower than the sides
// are steep, so that those that face it hide the others.
Scene grooves(const glm::dvec3& to_light) {
  Scene scene = mappedFloor(ridges());
  scene.lights.resize(1);
  scene.materials[0].params.surface.intensity = 0;
  const glm::dvec3 d = glm::normalize(to_light);
  scene.lights[0].direction = {static_cast<float>(d.x), static_cast<float>(d.y),
                               static_cast<float>(d.z), 0};
  return scene;
}
View fromU() {
  View view;
  view.fov_y_deg = 6;
  Orbit orbit;
  orbit.angle_deg = 35;
  orbit.azimuth_deg = 90;
  orbit.distance = 6;
  return orbitView(view, orbit);
}

double meanRed(const Image& image) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4)
    if (image.pixels[i + 3] > 0) sum += image.pixels[i], ++count;
  return sum / count;
}

// Mean of the absolute differences over covered pixels, over the mean of the reference.
double coveredDifference(const Image& image, const Image& reference) {
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 == 3 || reference.pixels[i / 4 * 4 + 3] == 0) continue;
    sum += std::abs(static_cast<double>(image.pixels[i]) - reference.pixels[i]);
    total += reference.pixels[i];
  }
  return sum / total;
}

Image relief(const Scene& scene, const View& view, double height_scale = 1, int spp = 64,
             int size_px = kReliefSize_px) {
  return renderDisplacedTruth(
      scene, view,
      {.width_px = size_px, .height_px = size_px, .spp = spp, .height_scale = height_scale});
}

TEST(DisplacedTruth, WithoutHeightIsTheTruthOfTheMap) {
  const Scene scene = mappedFloor(
      generateNormalMap({.kind = "bumps", .size_px = 64, .seed = 3, .height_scale = 2}));
  const View view = lookingDown(25, 1);
  const ShadingOptions options{.width_px = kReliefSize_px, .height_px = kReliefSize_px};
  const Image flat = renderTruth(testBench().device, scene, view, options, 256).mean;
  EXPECT_LT(coveredDifference(relief(scene, view, 0, 256), flat), 0.01);
  EXPECT_GT(coveredDifference(relief(scene, view, 1, 256), flat), 0.02)
      << "heights hide and shade nothing";
}

// Sides that face the eye fill the picture, and a light behind the eye lights all of them: a plane
// that leans by 45 degrees, but for the ridges' interpolated normals.
TEST(DisplacedTruth, GroovesShowTheSidesThatFaceTheEye) {
  const Scene scene = grooves({std::cos(35 * kDegree), std::sin(35 * kDegree), 0});
  Scene plane = scene;
  NormalMap leaning = ridges();
  for (glm::vec3& n : leaning.normals) n = glm::normalize(glm::vec3(kSlope, 0, 1));
  plane.materials[0].normal_map->map = std::make_shared<const NormalMap>(leaning);
  const double want = meanRed(relief(plane, fromU(), 0));
  EXPECT_NEAR(meanRed(relief(scene, fromU())) / want, 1, 0.04);
  EXPECT_LT(meanRed(relief(scene, fromU(), 0)) / want, 0.7) << "of a map both sides are seen";
}

// From the other side, lower than the sides are steep, the light meets none of them.
TEST(DisplacedTruth, GroovesAreDarkUnderALightThatTheirSidesTurnFrom) {
  const Scene scene = grooves({-std::cos(35 * kDegree), std::sin(35 * kDegree), 0});
  const double lit = meanRed(relief(scene, fromU(), 0));
  EXPECT_LT(meanRed(relief(scene, fromU())), 0.05 * lit);
}

TEST(DisplacedTruth, RefusesWhatItDoesNotKnow) {
  Scene scene = grooves({0, 1, 0});
  const auto message = [](const Scene& of) {
    try {
      relief(of, fromU(), 1, 1, 2);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(scene), "");
  Scene wide = scene;
  wide.lights[0].direction.w = 0.1f;
  EXPECT_NE(message(wide).find("wider than a point"), std::string::npos);
  Scene bent = scene;
  bent.mesh.positions[2].y = 1;
  EXPECT_NE(message(bent).find("not one flat rectangle"), std::string::npos);
  Scene normals = scene;
  NormalMap map = ridges();
  map.heights.clear();
  normals.materials[0].normal_map->map = std::make_shared<const NormalMap>(map);
  EXPECT_NE(message(normals).find("made of heights"), std::string::npos);
}

// Steep bumps, low over the surface: what LEADR is for.
TEST(DisplacedTruth, LeadrIsNearerToItThanLean) {
  const Scene scene = mappedFloor(
      generateNormalMap({.kind = "bumps", .size_px = 128, .seed = 3, .height_scale = 3}));
  const View view = lookingDown(20, 6);
  const auto textures = std::make_shared<NormalTextures>(testBench().device);
  const Image truth = relief(scene, view, 1, 128);
  const auto error = [&](NormalMethod method) {
    ShadingOptions options{.width_px = kReliefSize_px, .height_px = kReliefSize_px};
    options.normal_method = method;
    FrameRenderer renderer(testBench().device, scene, view, options, 1, textures);
    renderer.prepare();
    renderer.shade();
    return coveredDifference(renderer.readRadiance(), truth);
  };
  EXPECT_LT(error(NormalMethod::kLeadr), 0.7 * error(NormalMethod::kLean));
}

}  // namespace
}  // namespace glintmark
