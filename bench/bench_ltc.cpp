// The integral of a transformed cosine over one polygon light (kernels/area/polygon.clh, ltc.clh):
// corners of the light, clipped to the horizon or not, with and without the diffuse term.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "bench/device_bench.h"
#include "host/harness/area_light_harness.h"

namespace glintmark::bench {
namespace {

constexpr std::size_t kPoints = 1 << 15;

// Points of a floor around the light's foot: it crosses the horizon of some.
std::vector<HandMadePoint> floorPoints() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(-4, 4), cosine(0.05, 1), roughness(0.1, 1);
  std::vector<HandMadePoint> points(kPoints);
  for (HandMadePoint& point : points) {
    point.position = {across(random), across(random), 0};
    const double z = cosine(random);
    point.view = {std::sqrt(1 - z * z), 0, z};
    point.alpha = roughness(random);
  }
  return points;
}

AreaLight uprightLight(int corners) {
  std::vector<glm::dvec3> vertices;
  for (int i = 0; i < corners; ++i) {
    const double turn = 2 * std::numbers::pi * (i + 0.5) / corners;
    vertices.emplace_back(std::cos(turn), 0, 0.5 + std::sin(turn));
  }
  return polygonLight(std::move(vertices), true);
}

void light(benchmark::State& state, int corners, bool clipless, bool diffuse, int lanes) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  if (diffuse) probe.material.surface.albedo = whiteDiffuse().surface.albedo;
  probe.lights = {uprightLight(corners)};
  probe.table = shippedLtcTable(reference::Ndf::kGgx);
  probe.width = lanes;
  probe.clipless = clipless;
  const std::vector<HandMadePoint> points = floorPoints();
  timeKernel(state, "probeAreaLights", kPoints, "point",
             [&] { lightPoints(deviceBench(), probe, points); });
}

void registerAll() {
  const auto add = [](int corners, bool clipless, bool diffuse) {
    registerLanes(fmt::format("ltc/corners:{}/{}{}", corners, clipless ? "clipless" : "clipped",
                              diffuse ? "/diffuse" : ""),
                  [=](benchmark::State& state, int lanes) {
                    light(state, corners, clipless, diffuse, lanes);
                  });
  };
  for (const int corners : {3, 4, 8}) add(corners, false, false);
  add(4, true, false);
  add(4, false, true);
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
