// Cone lights against brute force over the cone's directions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/reference/light_cone.h"
#include "tests/glint/pixel_harness.h"

namespace glintmark {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kSamples = 40000;

// A cone is a set of taps, each a narrow lobe to first order. What that leaves, relative to the
// brightest that a light of that size gives the view: on average over views and lights, and at
// worst, which is a view 10 degrees above the surface under a light as wide as the sky.
constexpr double kMeanConeTolerance = 0.015;
constexpr double kWorstConeTolerance = 0.08;
constexpr double kDiffuseTolerance = 0.02;

glm::dvec3 direction(double angle_deg, double turn_deg) {
  const double a = angle_deg * kDegree, t = turn_deg * kDegree;
  return {std::sin(a) * std::cos(t), std::sin(a) * std::sin(t), std::cos(a)};
}

HandMadeFrame onePixel(const glm::dvec3& light, const glm::dvec3& view, double half_angle_rad) {
  HandMadeFrame frame;
  frame.pixels.resize(1);
  frame.pixels[0].frame = flatFrame();
  frame.ray_origin = -view;
  frame.lights = {coneLight(light, half_angle_rad)};
  return frame;
}

double kernelSmooth(HandMadeFrame frame, bool diffuse) {
  KernelConfig config;
  config.width = 1;
  config.glint = config.size_variation = false;
  config.light_cone = true;
  config.diffuse = diffuse;
  return shadePixels(frame, config).radiance[0].x;
}

class LightCone : public testing::TestWithParam<double> {};

// Error of the kernel's lobe relative to the brightest of that view.
double coneError(const glm::dvec3& axis, double view_deg, double half_rad,
                 const glm::dvec2& alpha) {
  const glm::dvec3 view = direction(view_deg, 0);
  HandMadeFrame frame = onePixel(axis, view, half_rad);
  frame.material = simpleMaterial({static_cast<float>(alpha.x), static_cast<float>(alpha.y)},
                                  {0.05f, 0.05f}, 1e6f);
  const auto brute_force = [&](const glm::dvec3& towards) {
    return reference::coneRadiance({towards, half_rad}, view, alpha, glm::dvec3(1.0), kSamples).x;
  };
  const double want = brute_force(axis), brightest = brute_force(direction(view_deg, 180));
  return std::abs(kernelSmooth(frame, false) - want) / std::max(brightest, want);
}

TEST_P(LightCone, SmoothLobeMatchesBruteForce) {
  const double half_rad = GetParam() * kDegree;
  for (const glm::dvec2& alpha : {glm::dvec2(0.1), glm::dvec2(0.3), glm::dvec2(0.5, 0.15)}) {
    double sum = 0, worst = 0;
    int count = 0;
    for (const double view_deg : {0.0, 30.0, 60.0, 80.0})
      for (const double light_deg : {0.0, 20.0, 50.0, 75.0, 85.0, 95.0}) {
        const double error = coneError(direction(light_deg, 160), view_deg, half_rad, alpha);
        sum += error;
        worst = std::max(worst, error);
        ++count;
      }
    std::printf("cone %g deg, alpha %.2f x %.2f: mean error %.2f %%, worst %.2f %%\n", GetParam(),
                alpha.x, alpha.y, 100 * sum / count, 100 * worst);
    EXPECT_LT(sum / count, kMeanConeTolerance);
    EXPECT_LT(worst, kWorstConeTolerance);
  }
}

TEST_P(LightCone, DiffuseTermMatchesBruteForce) {
  const double half_rad = GetParam() * kDegree;
  for (const double light_deg : {0.0, 40.0, 80.0, 95.0}) {
    const glm::dvec3 axis = direction(light_deg, 160);
    HandMadeFrame frame = onePixel(axis, {0, 0, 1}, half_rad);
    frame.material = simpleMaterial({0.3f, 0.3f}, {0.05f, 0.05f}, 1e6f);
    frame.material.intensity = 0;
    frame.material.albedo = {1, 1, 1, 0};
    const double want = reference::coneDiffuse({axis, half_rad}, kSamples);
    EXPECT_NEAR(kernelSmooth(frame, true), want, kDiffuseTolerance / std::numbers::pi) << light_deg;
  }
}

TEST_P(LightCone, GlintsUnderItKeepTheEnergy) {
  // The mean over many pixels of glints is the smooth lobe for lights of every size.
  HandMadeFrame frame = onePixel(direction(40, 160), direction(20, 0), GetParam() * kDegree);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.05f, 0.05f}, 1e7f, 1);
  const double smooth = kernelSmooth(frame, false);
  const HandMadePixel prototype = frame.pixels[0];
  frame.pixels.clear();
  for (int i = 0; i < 1 << 16; ++i) {
    HandMadePixel pixel = prototype;
    pixel.footprint.u = fixedCoordinate(0.0123 * (i % 256));
    pixel.footprint.v = fixedCoordinate(0.0117 * (i / 256));
    pixel.footprint.duv_dx = {3e-3, 1e-3};
    pixel.footprint.duv_dy = {-1e-3, 4e-3};
    frame.pixels.push_back(pixel);
  }
  for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact}) {
    KernelConfig config;
    config.width = 16;
    config.light_cone = true;
    config.method = method;
    double sum = 0;
    for (const glm::vec3& radiance : shadePixels(frame, config).radiance) sum += radiance.x;
    EXPECT_NEAR(sum / static_cast<double>(frame.pixels.size()) / smooth, 1, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(HalfAngles, LightCone, testing::Values(0.0, 1.0, 5.0, 15.0, 45.0, 90.0),
                         [](const auto& angle) {
                           return "deg" + std::to_string(static_cast<int>(angle.param));
                         });

}  // namespace
}  // namespace glintmark
