// Glints under polygon lights: the share of microdetails that mirrors a light against brute force
// over the polygon in double precision, tiny lights against points, and the mean of many pixels
// against the smooth lobe.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/core/angles.h"
#include "host/fit/ltc_table.h"
#include "host/frame/effect/area_lights.h"
#include "host/frame/frame_renderer.h"
#include "host/harness/area_light_harness.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/small_scenes.h"
#include "host/harness/tolerances.h"
#include "host/reference/light_cone.h"
#include "host/reference/light_polygon.h"
#include "host/reference/polygon_light.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kPolygonSamples = 10000;
constexpr int kCasesPerLight = 12;

struct LitDetail {
  glm::dvec3 position, view;  // of the point; the light stands still
};

// The share of reflecting microdetails at each point. Positions and views are rounded to single
// precision, as the kernel sees them.
std::vector<double> probeDetails(const CheckContext& context, std::vector<LitDetail>& cases,
                                 const AreaLight& light, const reference::DetailLobes& lobes) {
  const std::size_t n = paddedCount(cases.size());
  std::vector<float> in(6 * n), out(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const LitDetail& c = cases[std::min(i, cases.size() - 1)];
    for (int k = 0; k < 3; ++k) {
      in[static_cast<std::size_t>(k) * n + i] = static_cast<float>(c.position[k]);
      in[static_cast<std::size_t>(k + 3) * n + i] = static_cast<float>(c.view[k]);
    }
  }
  const auto alpha = static_cast<float>(lobes.alpha_g);
  const MaterialParams material = simpleMaterial(
      {alpha, alpha}, {static_cast<float>(lobes.alpha_l.x), static_cast<float>(lobes.alpha_l.y)},
      1e6f);
  const LtcTable table = shippedLtcTable(lobes.ndf);
  Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe);
  const std::vector<KernelArg> args = {
      probeData(context.bench, in),
      probeData(context.bench, std::vector{material}),
      probeData(context.bench, prepareAreaLights(std::vector{light}, glm::dvec3(0))),
      probeData(context.bench, table.values),
      output,
      static_cast<std::uint32_t>(table.size),
      static_cast<std::uint32_t>(n)};
  probeKernel(context.bench, "probes/probe_area_glint.cl", "probeAreaGlint",
              fmt::format("-D WIDTH={} -D LTC=1 -D AREA_GLINTS=1 -D LIGHT_VERTICES={} -D GGX={:d}",
                          context.lanes, light.vertices.size(), lobes.ndf == reference::Ndf::kGgx))
      .launch(args, n / static_cast<std::size_t>(context.lanes), kLocalSize);
  output.read(out.data(), out.size() * 4);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(cases.size())};
}

glm::dvec3 raised(double elevation_rad, double turn_rad) {
  return {std::cos(elevation_rad) * std::cos(turn_rad),
          std::cos(elevation_rad) * std::sin(turn_rad), std::sin(elevation_rad)};
}

// A regular polygon about the origin that faces -`towards`, of circumradius `size`.
AreaLight roundLight(int vertices, double size, const glm::dvec3& towards) {
  const glm::dvec3 aside = std::abs(towards.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(aside, towards)), v = glm::cross(towards, u);
  std::vector<glm::dvec3> points;
  for (int k = 0; k < vertices; ++k) {
    const double turn = 2 * std::numbers::pi * k / vertices + 0.3;
    points.push_back(glm::vec3(size * (std::cos(turn) * u + std::sin(turn) * v)));
  }
  return polygonLight(points, true);
}

struct DetailCase {
  AreaLight light;
  std::vector<LitDetail> points;
};

// Points around a light at distance 1 that see it where a slope of the lobe mirrors it.
DetailCase detailCase(int vertices, double size, double alpha, unsigned seed,
                      std::span<const double> views_deg) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  std::normal_distribution<double> normal(0, 0.6);
  DetailCase made{roundLight(vertices, size, raised(turn(random) / 8, turn(random))), {}};
  while (made.points.size() < kCasesPerLight) {
    const double elevation_deg = views_deg[made.points.size() % views_deg.size()];
    const glm::dvec3 view = raised(elevation_deg * kDegree, turn(random));
    const glm::dvec3 m =
        glm::normalize(glm::dvec3(alpha * normal(random), alpha * normal(random), 1));
    const glm::dvec3 i = 2 * glm::dot(view, m) * m - view;
    if (i.z <= 0.02) continue;
    made.points.push_back({-glm::dvec3(glm::vec3(i)), glm::normalize(glm::dvec3(glm::vec3(view)))});
  }
  return made;
}

constexpr double kAllViews_deg[] = {3, 10, 20, 40, 60, 90};
constexpr double kRoughness[] = {0.05, 0.1, 0.25, 0.5, 0.8};

// The share against brute force, relative, where it is at all likely; nine of ten lights stay below
// the bound.
Finding probability(const CheckContext& context, reference::Ndf ndf) {
  Finding finding(kPolygonProbability);
  std::vector<double> errors;
  unsigned seed = 0;
  for (const double alpha : kRoughness)
    for (const double micro : {0.15, 0.6})
      for (const double size : {0.03, 0.2, 0.8}) {
        const int vertices = 3 + static_cast<int>(seed % 6);
        DetailCase c = detailCase(vertices, size, alpha, ++seed, kAllViews_deg);
        const reference::DetailLobes lobes{ndf, alpha, glm::dvec2(micro * alpha)};
        const std::vector<double> probed = probeDetails(context, c.points, c.light, lobes);
        for (std::size_t i = 0; i < probed.size(); ++i) {
          std::vector<glm::dvec3> local;
          for (const glm::dvec3& v : c.light.vertices) local.push_back(v - c.points[i].position);
          const double want =
              reference::polygonProbability(local, c.points[i].view, lobes, kPolygonSamples);
          if (want < 0.01) continue;
          const double ratio = probed[i] / want;
          finding.require(
              ratio > 1 / kProbabilityMagnitude && ratio < kProbabilityMagnitude,
              fmt::format("a light of size {} at roughness {} has {:.2g} times its share", size,
                          alpha, ratio));
          errors.push_back(std::abs(ratio - 1));
        }
      }
  std::ranges::sort(errors);
  finding.require(errors.size() > 100, "too few lights mirror enough");
  if (!errors.empty()) finding.add(errors[errors.size() * 9 / 10]);
  return finding;
}

// A light of a few thousandths of the lobe's width, against a cone of the same solid angle in the
// same place.
Finding tinyLight(const CheckContext& context) {
  constexpr double kViews_deg[] = {30, 45, 60, 90};
  Finding finding(kPolygonProbability);
  std::vector<double> errors;
  unsigned seed = 900;
  for (const double alpha : {0.1, 0.3, 0.6}) {
    DetailCase c = detailCase(5, 0.004 * alpha, alpha, ++seed, kViews_deg);
    const reference::DetailLobes lobes{reference::Ndf::kBeckmann, alpha, glm::dvec2(0.3 * alpha)};
    const std::vector<double> probed = probeDetails(context, c.points, c.light, lobes);
    for (std::size_t i = 0; i < probed.size(); ++i) {
      const LitDetail& point = c.points[i];
      std::vector<glm::dvec3> local;
      for (const glm::dvec3& v : c.light.vertices) local.push_back(v - point.position);
      const double angle = std::abs(reference::polygonSolidAngle(local));
      const glm::dvec3 axis = glm::normalize(-point.position);
      const reference::Cone cone{axis, std::acos(1 - angle / (2 * std::numbers::pi))};
      const glm::dvec3 h = axis + point.view;
      if (glm::length(glm::dvec2(h) / h.z) > alpha) continue;
      const double want = reference::coneProbability(cone, point.view, glm::dvec2(alpha),
                                                     lobes.alpha_l, false, 2000);
      errors.push_back(std::abs(probed[i] / want - 1));
    }
  }
  std::ranges::sort(errors);
  finding.require(errors.size() > 10, "too few lights lie within the lobe");
  if (!errors.empty()) finding.add(errors[errors.size() * 9 / 10]);
  return finding;
}

// A floor of glints under one polygon; no other light.
Scene litFloor(const AreaLight& light, bool ggx) {
  Scene scene = floorScene();
  scene.lights.clear();
  scene.materials[0].ggx = ggx;
  scene.area_lights = {light};
  return scene;
}

struct FloorLight {
  const char* name;
  int vertices;
  double size;
  bool ggx;
};
constexpr FloorLight kFloorLights[] = {{"triangle", 3, 0.4, false},
                                       {"quad", 4, 0.1, false},
                                       {"octagon", 8, 1, false},
                                       {"ggx", 4, 0.4, true}};

// The mean over a frame of glints and of the smooth lobe.
Finding energy(const CheckContext& context, const FloorLight& kind) {
  AreaLight light = roundLight(kind.vertices, kind.size, glm::normalize(glm::dvec3(0.1, -1, 0.6)));
  for (glm::dvec3& v : light.vertices) v += glm::dvec3(0.1, 1.2, -1);
  light.radiance = {3, 3, 3};
  const Scene scene = litFloor(light, kind.ggx);
  ShadingOptions options{.width_px = 512, .height_px = 512, .lanes = context.lanes};
  const auto render = [&] {
    FrameRenderer renderer(context.bench.device, scene, lookingDown(50), options, 1);
    renderer.prepare();
    renderer.shade();
    return renderer.readRadiance();
  };
  const Image glints = render();
  options.glints = false;
  const Image smooth = render();
  double sum = 0, wanted = 0, squares = 0, different = 0;
  for (std::size_t i = 0; i < smooth.pixels.size(); i += 4) {
    const double d = glints.pixels[i] - smooth.pixels[i];
    sum += d;
    squares += d * d;
    wanted += smooth.pixels[i];
    different += std::abs(d);
  }
  Finding finding(kEnergyTolerance);
  finding.add(std::abs(sum) / wanted);
  finding.require(std::sqrt(squares) / wanted < kEnergyTolerance / 4,
                  "too few pixels to tell the mean");
  finding.require(different > 0.05 * wanted, "glints do not differ from the smooth lobe");
  return finding;
}

}  // namespace

std::vector<Check> areaGlintChecks() {
  std::vector<Check> checks = {
      {"area_glint/probability_beckmann", "relative error of p, 9 of 10",
       [](const CheckContext& c) { return probability(c, reference::Ndf::kBeckmann); }},
      {"area_glint/probability_ggx", "relative error of p, 9 of 10",
       [](const CheckContext& c) { return probability(c, reference::Ndf::kGgx); }},
      {"area_glint/tiny_light", "relative error of p, 9 of 10", tinyLight}};
  for (const FloorLight& kind : kFloorLights)
    checks.push_back({std::string("area_glint/energy_") + kind.name, "relative error of the mean",
                      [&kind](const CheckContext& c) { return energy(c, kind); }});
  return checks;
}

}  // namespace glintmark
