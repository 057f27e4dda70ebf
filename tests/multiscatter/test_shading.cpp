// The shading kernels' models against double precision, on a plane under one light.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>

#include "host/core/angles.h"
#include "host/fit/lobe_model.h"
#include "host/fit/multiscatter_data.h"
#include "host/frame/frame_renderer.h"
#include "host/scene/load_scene.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

// Single precision and the interpolated shares, which are good to 1e-4.
constexpr double kTolerance = 2e-3;

double reference(DiffuseModel model, double alpha, double albedo, const glm::dvec3& light,
                 const glm::dvec3& view) {
  if (model == DiffuseModel::kEon) {
    const EonValue v = eonBrdf(light, view, multiscatterData().eon.at(alpha), albedo);
    return (v.single + v.multiple) * light.z;
  }
  if (model == DiffuseModel::kFitted) {
    const double azimuth = std::atan2(light.y, light.x) - std::atan2(view.y, view.x);
    return ScatterModel(multiscatterData().fitted.at(alpha))
               .energy(albedo, light.z, view.z, azimuth) /
           view.z * light.z;
  }
  const LobePolynomials& p =
      model == DiffuseModel::kRefit ? multiscatterData().refit : kPublishedCode;
  return LobeModel(p, alpha).energy(albedo, light.z, view.z) / view.z * light.z;
}

TEST(MultiscatterShading, KernelsAgreeWithDoublePrecision) {
  Device& device = testBench().device;
  for (const char* name : {"published", "refit", "eon", "fitted"})
    for (const double alpha : {0.0, 0.08, 0.8, 1.0}) {
      SceneRequest request;
      request.scene = "rough_plane";
      request.overrides = {fmt::format("material.clay.diffuse_model={}", name),
                           fmt::format("material.clay.diffuse_roughness={}", alpha),
                           "material.clay.intensity=0"};
      const Scene scene = loadScene(request);
      const Material& material = scene.materials.front();
      FrameRenderer renderer(device, scene, scene.views.front(), {.width_px = 32, .height_px = 18});
      renderer.prepare();
      renderer.shade();
      const Image image = renderer.readRadiance();
      // The plane is y = 0: its normal is y, and models without a direction of their own need no
      // more than the local frame's cosines.
      const auto local = [](const glm::dvec3& w) { return glm::dvec3(w.x, w.z, w.y); };
      const float4 towards = scene.lights.front().direction;
      const glm::dvec3 light = local(glm::normalize(glm::dvec3(towards.x, towards.y, towards.z)));
      const double irradiance = scene.lights.front().irradiance.x;
      for (const auto& [x, y] : {std::pair(3, 2), std::pair(16, 9), std::pair(30, 16)}) {
        const glm::dvec3 view = local(-glm::normalize(renderer.camera().ray(x, y)));
        const double expected =
            irradiance *
            reference(material.diffuse_model, alpha, material.params.surface.albedo.x, light, view);
        EXPECT_NEAR(image.at(x, y)[0], expected, kTolerance * expected)
            << name << " " << alpha << " " << x << "," << y;
      }
    }
}

TEST(MultiscatterShading, NothingIsNegativeOrNotANumberAtTheHorizon) {
  Device& device = testBench().device;
  for (const char* name : {"published", "refit", "eon", "fitted"}) {
    SceneRequest request;
    request.scene = "rough_plane";
    request.overrides = {fmt::format("material.clay.diffuse_model={}", name),
                         "material.clay.diffuse_roughness=0.08", "material.clay.compensation=lobe",
                         "light.sun.elevation_deg=0", "view.oblique.orbit.angle_deg=0.1"};
    const Scene scene = loadScene(request);
    FrameRenderer renderer(device, scene, scene.views.front(), {.width_px = 64, .height_px = 36});
    renderer.prepare();
    renderer.shade();
    for (const float value : renderer.readRadiance().pixels) {
      EXPECT_TRUE(std::isfinite(value)) << name;
      EXPECT_GE(value, 0) << name;
    }
  }
}

TEST(MultiscatterShading, WhatIsOffLeavesNoSwitchOn) {
  Device& device = testBench().device;
  SceneRequest request;
  request.scene = "rough_plane";
  request.overrides = {"material.clay.diffuse_model=lambert"};
  const Scene scene = loadScene(request);
  FrameRenderer renderer(device, scene, scene.views.front(), {.width_px = 8, .height_px = 8});
  renderer.prepare();
  ASSERT_EQ(renderer.configs().size(), 1u);
  EXPECT_EQ(renderer.configs().front().multiscatter, Multiscatter::kOff);
  EXPECT_EQ(renderer.configs().front().metal_compensation, MetalCompensation::kOff);
}

}  // namespace
}  // namespace glintmark
