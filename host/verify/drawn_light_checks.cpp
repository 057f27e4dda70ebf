// Glints under many lights, of which a pixel draws the brightest one by one and the others as one:
// the same mean, the same spread and no jumps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "host/core/angles.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/reference/cone_chances.h"
#include "host/scene/environment.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr float kSkyRoughness = 0.5f, kSkyMicro = 0.05f;  // alpha_g, alpha_l
constexpr int kSkyPixels = 1 << 13;
// Of what all cones make of pixels, on average.
constexpr double kFineCut = 0.004, kMediumCut = 0.015, kCoarseCut = 0.12;

// The sky of scene glitter, cut into cones, with the zenith along the normal.
std::vector<ConeLight> skyCones(int count) {
  SkyParameters sky;
  const auto lamp = [&](double azimuth_deg, double elevation_deg, double half_deg,
                        const glm::dvec3& radiance) {
    const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
    sky.lamps.push_back({{std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)},
                         half_deg * kDegree,
                         radiance});
  };
  lamp(40, 45, 9, {30, 28, 24});
  lamp(-70, 20, 6, {12, 16, 24});
  lamp(170, 60, 5, {30, 22, 14});
  std::vector<ConeLight> cones = cutEnvironment(renderSky(sky), {.cone_count = count});
  // The map's +y is up; here z is.
  for (ConeLight& cone : cones) std::swap(cone.direction.y, cone.direction.z);
  return cones;
}

// Square pixels at random places, seen at 50 degrees.
HandMadeFrame skyFrame(std::vector<ConeLight> lights, double per_pixel) {
  HandMadeFrame frame;
  std::mt19937 random(17);
  const auto place = [&] { return 64 * (static_cast<double>(random()) * 0x1p-32 - 0.5); };
  frame.pixels.resize(kSkyPixels);
  const double side = 1.3e-3;
  for (HandMadePixel& pixel : frame.pixels) {
    pixel.footprint.u = fixedCoordinate(place());
    pixel.footprint.v = fixedCoordinate(place());
    pixel.footprint.duv_dx = {side, 0};
    pixel.footprint.duv_dy = {0, side};
    pixel.frame = flatFrame();
  }
  frame.ray_origin = {std::cos(50 * kDegree), 0, -std::sin(50 * kDegree)};
  frame.ray_dx = frame.ray_dy = glm::dvec3(0);
  frame.material = simpleMaterial({kSkyRoughness, kSkyRoughness}, {kSkyMicro, kSkyMicro},
                                  static_cast<float>(per_pixel / (side * side)));
  frame.lights = std::move(lights);
  return frame;
}

KernelConfig skyConfig(int lanes, int drawn, bool glint = true) {
  KernelConfig config;
  config.width = lanes;
  config.method = GlintMethod::kDistributed;
  config.size_variation = false;
  config.light_cone = true;
  config.glint = glint;
  config.drawn_lights = glint ? drawn : 0;
  return config;
}

double luminanceOf(const glm::vec3& c) {
  return 0.2126 * double{c.x} + 0.7152 * double{c.y} + 0.0722 * double{c.z};
}

// Of the smooth lobe under these lights.
double smoothOf(const CheckContext& context, HandMadeFrame frame) {
  frame.pixels.resize(1);
  return luminanceOf(
      shadePixels(context.bench, frame, skyConfig(context.lanes, 0, false)).radiance[0]);
}

std::vector<double> drawnOver(const CheckContext& context, const HandMadeFrame& frame, int drawn,
                              double smooth) {
  std::vector<double> values;
  for (const glm::vec3& c :
       shadePixels(context.bench, frame, skyConfig(context.lanes, drawn)).radiance)
    values.push_back(luminanceOf(c) / smooth);
  return values;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Between two samples of as many values.
double wasserstein(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

// What pixels should be like: every microdetail under every cone, by brute force.
std::vector<double> bruteForce(const CheckContext& context, const HandMadeFrame& frame,
                               int per_pixel, double smooth, std::uint32_t seed) {
  std::vector<reference::ConeShare> lights;
  for (const ConeLight& light : frame.lights) {
    HandMadeFrame one = frame;
    one.lights = {light};
    const glm::dvec3 axis(light.direction.x, light.direction.y, light.direction.z);
    lights.push_back({{glm::normalize(axis), static_cast<double>(light.direction.w)},
                      smoothOf(context, one) / smooth});
  }
  return reference::pixelsUnderCones(lights, -frame.ray_origin, double{kSkyRoughness},
                                     double{kSkyMicro}, per_pixel, kSkyPixels, seed);
}

Finding skyMean(const CheckContext& context) {
  Finding finding(kEnergyTolerance);
  for (const int drawn : {1, 4, 8}) {
    const HandMadeFrame frame = skyFrame(skyCones(24), 3e4);
    finding.add(std::abs(meanOf(drawnOver(context, frame, drawn, smoothOf(context, frame))) - 1));
  }
  return finding;
}

double deviationOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::abs(value - 1);
  return sum / static_cast<double>(values.size());
}

// Under so many cones, of which so many are drawn one by one; 0 for all.
Finding skySpread(const CheckContext& context, int cones, int drawn) {
  constexpr int kPerPixel = 300;
  const HandMadeFrame frame = skyFrame(skyCones(cones), kPerPixel);
  const double smooth = smoothOf(context, frame);
  const std::vector<double> truth = bruteForce(context, frame, kPerPixel, smooth, 5);
  Finding finding(kDrawnSpread);
  finding.add(wasserstein(drawnOver(context, frame, drawn, smooth), truth) / deviationOf(truth));
  return finding;
}

// Fewer lights than are drawn: nothing is left to draw as one.
Finding skyOfFew(const CheckContext& context) {
  Finding finding(kShareTolerance);
  const HandMadeFrame frame = skyFrame(skyCones(4), 1000);
  const double smooth = smoothOf(context, frame);
  const std::vector<double> all = drawnOver(context, frame, 0, smooth),
                            few = drawnOver(context, frame, 4, smooth);
  for (std::size_t i = 0; i < all.size(); ++i)
    finding.add(std::abs(all[i] - few[i]) / std::max(all[i], 1.0));
  return finding;
}

// Two lights of these irradiances, far apart for microdetails and mirrored for the lobe.
HandMadeFrame twoLights(double first, double second) {
  HandMadeFrame frame = skyFrame({}, 1000);
  frame.ray_origin = {0, 0, -1};
  frame.lights = {coneLight({0.3, 0.1, 1}, 0, first), coneLight({-0.3, -0.1, 1}, 0, second)};
  return frame;
}

// Two lights change ranks: their draws fade, so that nothing jumps.
Finding changeOfRanks(const CheckContext& context) {
  Finding finding(kDrawnJump);
  const HandMadeFrame before = twoLights(1.001, 0.999), after = twoLights(0.999, 1.001);
  const double smooth = smoothOf(context, before);
  const std::vector<double> a = drawnOver(context, before, 1, smooth),
                            b = drawnOver(context, after, 1, smooth);
  double change = 0;
  for (std::size_t i = 0; i < a.size(); ++i) change += std::abs(a[i] - b[i]);
  finding.add(change / static_cast<double>(a.size()) / deviationOf(a));
  finding.require(change > 0, "the lights do not change");
  return finding;
}

double varianceOf(const std::vector<double>& values) {
  const double mean = meanOf(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size());
}

// Half of the brighter light is drawn on its own, half with the other: variances add up to those of
// lights drawn one by one.
Finding halfDrawn(const CheckContext& context) {
  Finding finding(kDrawnVariance);
  const HandMadeFrame frame = twoLights(1.5, 1);
  const double smooth = smoothOf(context, frame);
  const double one = varianceOf(drawnOver(context, frame, 1, smooth)),
               all = varianceOf(drawnOver(context, frame, 0, smooth));
  finding.add(std::abs(one / all - 1));
  return finding;
}

Finding skyBits(const CheckContext& context) {
  Finding finding(0);
  const HandMadeFrame frame = skyFrame(skyCones(24), 300);
  const ShadedPixels one = shadePixels(context.bench, frame, skyConfig(1, 3)),
                     wide = shadePixels(context.bench, frame, skyConfig(context.lanes, 3));
  double different = 0;
  for (std::size_t i = 0; i < one.radiance.size(); ++i)
    different += one.radiance[i] != wide.radiance[i];
  finding.add(different);
  return finding;
}

// Cones that a lobe hardly tells apart count as one: against all of them, seen from anywhere.
Finding cutError(const CheckContext& context, LightCut cut, double bound) {
  Finding finding(bound);
  for (const float roughness : {0.1f, 0.3f, 0.55f}) {
    HandMadeFrame frame = skyFrame(skyCones(192), 1000);
    frame.pixels = randomPixels(1 << 10, {1e-4, 1e-3, 1.001});
    setRandomRays(frame);
    frame.material.surface.alpha_g = {roughness, roughness};
    frame.material.surface.albedo = {0.2f, 0.2f, 0.2f, 0};
    KernelConfig config = skyConfig(context.lanes, 0, false);
    config.diffuse = true;
    const ShadedPixels all = shadePixels(context.bench, frame, config);
    config.light_cut = cut;
    const ShadedPixels some = shadePixels(context.bench, frame, config);
    double square = 0, sum = 0;
    for (std::size_t i = 0; i < all.radiance.size(); ++i) {
      const double one = luminanceOf(all.radiance[i]);
      square += std::pow(luminanceOf(some.radiance[i]) - one, 2);
      sum += one;
    }
    const auto n = static_cast<double>(all.radiance.size());
    finding.add(std::sqrt(square / n) / (sum / n));
    finding.require(square > 0, "every cone is seen by itself");
  }
  return finding;
}

}  // namespace

std::vector<Check> drawnLightChecks() {
  std::vector<Check> checks = {
      {"drawn/mean", "mean over the smooth lobe - 1", skyMean},
      {"drawn/few", "change where there are no more lights", skyOfFew},
      {"drawn/ranks", "change where two change ranks", changeOfRanks},
      {"drawn/variance", "variance over that of all lights drawn - 1", halfDrawn},
      {"drawn/same_bits", "pixels that differ from one lane's", skyBits}};
  for (const auto& [cones, drawn] :
       {std::pair(12, 4), std::pair(24, 4), std::pair(48, 8), std::pair(96, 8), std::pair(48, 0)})
    checks.push_back({fmt::format("drawn/spread_{}_of_{}", drawn, cones),
                      "W1 to brute force, of its own deviation",
                      [cones = cones, drawn = drawn](const CheckContext& context) {
                        return skySpread(context, cones, drawn);
                      }});
  for (const auto& [name, cut, bound] : {std::tuple("fine", LightCut::kFine, kFineCut),
                                         std::tuple("medium", LightCut::kMedium, kMediumCut),
                                         std::tuple("coarse", LightCut::kCoarse, kCoarseCut)})
    checks.push_back({fmt::format("drawn/cut_{}", name), "rms error of 192 cones, of their mean",
                      [cut = cut, bound = bound](const CheckContext& context) {
                        return cutError(context, cut, bound);
                      }});
  return checks;
}

}  // namespace glintmark
