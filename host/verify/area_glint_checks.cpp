// Glints under polygon lights: the share of microdetails that mirrors a light against brute force
// over the polygon in double precision, tiny lights against points, and the mean of many pixels
// against the smooth lobe.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/core/angles.h"
#include "host/fit/ltc_lobe.h"
#include "host/frame/effect/area_lights.h"
#include "host/frame/frame_renderer.h"
#include "host/harness/area_light_harness.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/small_scenes.h"
#include "host/harness/specular_cases.h"
#include "host/harness/tolerances.h"
#include "host/reference/light_cone.h"
#include "host/reference/light_polygon.h"
#include "host/reference/polygon_light.h"
#include "host/verify/check_frames.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kPolygonSamples = 2000;
constexpr int kCasesPerLight = 6;

// What the kernel makes of a light at a point.
struct ProbedDetail {
  double probability, reflected;
};

struct LitDetail {
  glm::dvec3 position, view;  // of the point; the light stands still
};

// The tables that ship, read once.
const LtcTable& tableOf(reference::Ndf ndf) {
  static const LtcTable beckmann = shippedLtcTable(reference::Ndf::kBeckmann);
  return ndf == reference::Ndf::kGgx ? shippedGgx() : beckmann;
}

// Positions and views are rounded to single
// precision, as the kernel sees them.
std::vector<ProbedDetail> probeDetails(const CheckContext& context, std::vector<LitDetail>& cases,
                                       const AreaLight& light,
                                       const reference::DetailLobes& lobes) {
  const std::size_t n = paddedCount(cases.size());
  std::vector<float> in(6 * n), out(4 * n);
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
  const LtcTable& table = tableOf(lobes.ndf);
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
  std::vector<ProbedDetail> result;
  for (std::size_t i = 0; i < cases.size(); ++i) result.push_back({out[i], out[n + i]});
  return result;
}

glm::dvec3 skyward(double elevation_rad, double turn_rad) {
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
  DetailCase made{roundLight(vertices, size, skyward(turn(random) / 8, turn(random))), {}};
  while (made.points.size() < kCasesPerLight) {
    const double elevation_deg = views_deg[made.points.size() % views_deg.size()];
    const glm::dvec3 view = skyward(elevation_deg * kDegree, turn(random));
    const glm::dvec3 m =
        glm::normalize(glm::dvec3(alpha * normal(random), alpha * normal(random), 1));
    const glm::dvec3 i = 2 * glm::dot(view, m) * m - view;
    // Seen edge on, corners far from the lobe would decide.
    if (i.z <= 0.02 || std::abs(glm::dot(i, areaLightNormal(made.light))) < 0.2) continue;
    made.points.push_back({-glm::dvec3(glm::vec3(i)), glm::normalize(glm::dvec3(glm::vec3(view)))});
  }
  return made;
}

// A light's corners about a point.
std::vector<glm::dvec3> seenFrom(const AreaLight& light, const glm::dvec3& position) {
  std::vector<glm::dvec3> local;
  for (const glm::dvec3& v : light.vertices) local.push_back(v - position);
  return local;
}

// What the surface's lobe reflects of a light without Fresnel's term.
double reflectedBy(std::span<const glm::dvec3> light, const glm::dvec3& view, double alpha,
                   reference::Ndf ndf) {
  // Into the frame of the table, whose x axis the view lies along.
  const double sine = glm::length(glm::dvec2(view));
  const glm::dvec2 x = sine > 1e-9 ? glm::dvec2(view) / sine : glm::dvec2(1, 0);
  std::vector<glm::dvec3> turned;
  for (const glm::dvec3& v : light)
    turned.emplace_back(x.x * v.x + x.y * v.y, x.x * v.y - x.y * v.x, v.z);
  const LtcCell cell = lookUpLtc(tableOf(ndf), alpha, view.z);
  return std::abs(reference::microfacetOverPolygon(ndf, {sine, 0, view.z}, alpha, 1,
                                                   ltcInverseMatrix(cell, alpha, view.z), turned));
}

constexpr double kAllViews_deg[] = {3, 10, 20, 40, 60, 90};
constexpr double kDetailRoughness[] = {0.05, 0.1, 0.25, 0.5, 0.8};
constexpr double kDiscernible = 0.01;  // shares below it are not asked for

// Kernel over truth, at one point.
struct DetailRatios {
  double view_deg;
  double probability;  // of a microdetail mirroring the light
  double brightness;   // of one that does: what the lobe reflects, over the probability
};

// Lights of many sizes, over lobes of many widths. Each number of corners is a program to compile,
// so that the two lobes share them out.
std::vector<DetailRatios> detailRatios(const CheckContext& context, reference::Ndf ndf) {
  const std::vector<int> corners =
      ndf == reference::Ndf::kGgx ? std::vector{4, 6} : std::vector{3, 5, 8};
  std::vector<DetailRatios> ratios;
  unsigned seed = 0;
  for (const double alpha : kDetailRoughness)
    for (const double micro : {0.15, 0.6})
      for (const double size : {0.03, 0.2, 0.8}) {
        const int vertices = corners[seed % corners.size()];
        DetailCase c = detailCase(vertices, size, alpha, ++seed, kAllViews_deg);
        const reference::DetailLobes lobes{ndf, alpha, glm::dvec2(micro * alpha)};
        const std::vector<ProbedDetail> probed = probeDetails(context, c.points, c.light, lobes);
        for (std::size_t i = 0; i < probed.size(); ++i) {
          const glm::dvec3& view = c.points[i].view;
          const std::vector<glm::dvec3> local = seenFrom(c.light, c.points[i].position);
          const double want = reference::polygonProbability(local, view, lobes, kPolygonSamples);
          if (want < kDiscernible) continue;
          const double probability = probed[i].probability / want;
          const double reflected = probed[i].reflected / reflectedBy(local, view, alpha, ndf);
          ratios.push_back({std::asin(view.z) / kDegree, probability, reflected / probability});
        }
      }
  return ratios;
}

// What one reflecting microdetail sends, against brute force at any view.
Finding brightness(const CheckContext& context, reference::Ndf ndf) {
  Finding finding(kPolygonBrightness);
  std::vector<double> errors;
  for (const DetailRatios& ratios : detailRatios(context, ndf)) {
    finding.require(
        ratios.brightness > 1 / kProbabilityMagnitude && ratios.brightness < kProbabilityMagnitude,
        fmt::format("a microdetail is {:.2g} times as bright", ratios.brightness));
    errors.push_back(std::abs(ratios.brightness - 1));
  }
  finding.addMost(errors, 100);
  return finding;
}

// The share of microdetails that does, where the transformed cosine is near the lobe.
Finding probability(const CheckContext& context, reference::Ndf ndf) {
  Finding finding(ndf == reference::Ndf::kGgx ? kGgxPolygonProbability : kPolygonProbability);
  std::vector<double> errors;
  for (const DetailRatios& ratios : detailRatios(context, ndf))
    if (ratios.view_deg >= 30) errors.push_back(std::abs(ratios.probability - 1));
  finding.addMost(errors, 60);
  return finding;
}

// A light of a few thousandths of the lobe's width, against a cone of the same solid angle in the
// same place: what one microdetail sends.
Finding tinyLight(const CheckContext& context) {
  constexpr double kViews_deg[] = {10, 30, 45, 60, 90};
  Finding finding(kTinyPolygonBrightness);
  std::vector<double> errors;
  unsigned seed = 900;
  for (const double alpha : {0.1, 0.3, 0.6}) {
    DetailCase c = detailCase(5, 0.004 * alpha, alpha, ++seed, kViews_deg);
    const reference::DetailLobes lobes{reference::Ndf::kBeckmann, alpha, glm::dvec2(0.3 * alpha)};
    const std::vector<ProbedDetail> probed = probeDetails(context, c.points, c.light, lobes);
    for (std::size_t i = 0; i < probed.size(); ++i) {
      const LitDetail& point = c.points[i];
      const double angle_sr =
          std::abs(reference::polygonSolidAngle(seenFrom(c.light, point.position)));
      const glm::dvec3 axis = glm::normalize(-point.position);
      const reference::Cone cone{axis, std::acos(1 - angle_sr / (2 * std::numbers::pi))};
      const double share = reference::coneProbability(cone, point.view, glm::dvec2(alpha),
                                                      lobes.alpha_l, false, 2000);
      const double reflected = angle_sr * reference::microfacetTimesCosine(
                                              reference::Ndf::kBeckmann, axis, point.view, alpha);
      errors.push_back(
          std::abs(probed[i].reflected / probed[i].probability * share / reflected - 1));
    }
  }
  finding.addMost(errors, 15);
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
  return frameEnergy(context, litFloor(light, kind.ggx), lookingDown(50), 0.05);
}

}  // namespace

std::vector<Check> areaGlintChecks() {
  std::vector<Check> checks = {
      {"area_glint/brightness_beckmann", "error of one glint, 9 of 10",
       [](const CheckContext& c) { return brightness(c, reference::Ndf::kBeckmann); }},
      {"area_glint/brightness_ggx", "error of one glint, 9 of 10",
       [](const CheckContext& c) { return brightness(c, reference::Ndf::kGgx); }},
      {"area_glint/probability_beckmann", "relative error of p, 9 of 10",
       [](const CheckContext& c) { return probability(c, reference::Ndf::kBeckmann); }},
      {"area_glint/probability_ggx", "relative error of p, 9 of 10",
       [](const CheckContext& c) { return probability(c, reference::Ndf::kGgx); }},
      {"area_glint/tiny_light", "error of one glint, 9 of 10", tinyLight}};
  for (const FloorLight& kind : kFloorLights)
    checks.push_back({std::string("area_glint/energy_") + kind.name, "relative error of the mean",
                      [&kind](const CheckContext& c) { return energy(c, kind); }});
  return checks;
}

}  // namespace glintmark
