// The GGX lobe under lights of any width and its microdetails: against brute force in double
// precision over the cone, taken for a polygon of many corners.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/core/angles.h"
#include "host/fit/ltc_lobe.h"
#include "host/frame/effect/lights.h"
#include "host/frame/frame_renderer.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/small_scenes.h"
#include "host/harness/specular_cases.h"
#include "host/harness/tolerances.h"
#include "host/reference/light_polygon.h"
#include "host/reference/polygon_light.h"
#include "host/verify/check_frames.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr double kGgxViews_deg[] = {5, 15, 30, 60, 90};
constexpr double kGgxRoughness[] = {0.03, 0.1, 0.3, 0.6, 1};
constexpr double kGgxMicro = 0.3;
constexpr int kGgxCases = 16;
constexpr int kDiscCorners = 48;

struct GgxCase {
  glm::dvec3 axis, view;
};

struct ProbedGgx {
  double specular, probability;
};

glm::dvec3 lifted(double elevation_rad, double turn_rad) {
  return {std::cos(elevation_rad) * std::cos(turn_rad),
          std::cos(elevation_rad) * std::sin(turn_rad), std::sin(elevation_rad)};
}

// Lights that slopes of the lobe mirror, tails included, whole above the horizon.
std::vector<GgxCase> ggxCases(double alpha, double half_rad, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<GgxCase> cases;
  for (int tries = 0; cases.size() < kGgxCases && tries < 4000; ++tries) {
    const double elevation_deg = kGgxViews_deg[cases.size() % std::size(kGgxViews_deg)];
    const glm::dvec3 view = lifted(elevation_deg * kDegree, 2 * std::numbers::pi * unit(random));
    const double share = 0.98 * unit(random), radius = alpha * std::sqrt(share / (1 - share));
    const double turn = 2 * std::numbers::pi * unit(random);
    const glm::dvec3 m =
        glm::normalize(glm::dvec3(radius * std::cos(turn), radius * std::sin(turn), 1));
    const glm::dvec3 i = 2 * glm::dot(view, m) * m - view;
    if (i.z < std::sin(half_rad) + 0.01) continue;
    cases.push_back(
        {glm::normalize(glm::dvec3(glm::vec3(i))), glm::normalize(glm::dvec3(glm::vec3(view)))});
  }
  return cases;
}

std::vector<ProbedGgx> probeGgx(const CheckContext& context, const std::vector<GgxCase>& cases,
                                double alpha, double half_rad) {
  const std::size_t n = paddedCount(cases.size());
  std::vector<float> in(6 * n), out(5 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const GgxCase& c = cases[std::min(i, cases.size() - 1)];
    for (int k = 0; k < 3; ++k) {
      in[static_cast<std::size_t>(k) * n + i] = static_cast<float>(c.axis[k]);
      in[static_cast<std::size_t>(k + 3) * n + i] = static_cast<float>(c.view[k]);
    }
  }
  const auto global = static_cast<float>(alpha), micro = static_cast<float>(kGgxMicro * alpha);
  Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe);
  const std::vector<KernelArg> args = {
      probeData(context.bench, in), output, static_cast<std::uint32_t>(n),
      probeData(context.bench, std::vector{simpleMaterial({global, global}, {micro, micro}, 1e6f)}),
      probeData(context.bench, prepareLights(std::vector{coneLight({0, 0, 1}, half_rad)}))};
  probeKernel(context.bench, "probes/probe_cone.cl", "probeCone",
              fmt::format("-D WIDTH={} -D LIGHT_CONE=1 -D GGX=1", context.lanes))
      .launch(args, n / static_cast<std::size_t>(context.lanes), kLocalSize);
  output.read(out.data(), out.size() * 4);
  std::vector<ProbedGgx> result;
  for (std::size_t i = 0; i < cases.size(); ++i) result.push_back({out[i], out[3 * n + i]});
  return result;
}

// A cone of directions as a polygon of its solid angle.
std::vector<glm::dvec3> disc(const glm::dvec3& axis, double half_rad) {
  const glm::dvec3 aside = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(aside, axis)), v = glm::cross(axis, u);
  const auto corners = [&](double radius) {
    std::vector<glm::dvec3> points;
    for (int k = 0; k < kDiscCorners; ++k) {
      const double turn = 2 * std::numbers::pi * k / kDiscCorners;
      points.push_back(axis + radius * (std::cos(turn) * u + std::sin(turn) * v));
    }
    return points;
  };
  const double half_sin = std::sin(half_rad / 2),
               wanted = 4 * std::numbers::pi * half_sin * half_sin;
  double radius = std::tan(half_rad);
  for (int step = 0; step < 8; ++step)
    radius *= std::sqrt(wanted / std::abs(reference::polygonSolidAngle(corners(radius))));
  return corners(radius);
}

// The mean of the lobe over the cone.
double wantedLobe(const GgxCase& c, double alpha, double half_rad) {
  const std::vector<glm::dvec3> light = disc(c.axis, half_rad);
  // Into the frame of the table, whose x axis the view lies along.
  const double sine = glm::length(glm::dvec2(c.view));
  const glm::dvec2 x = sine > 1e-9 ? glm::dvec2(c.view) / sine : glm::dvec2(1, 0);
  std::vector<glm::dvec3> turned;
  for (const glm::dvec3& v : light)
    turned.emplace_back(x.x * v.x + x.y * v.y, x.x * v.y - x.y * v.x, v.z);
  const LtcCell cell = lookUpLtc(shippedGgx(), alpha, c.view.z);
  const glm::dmat3 inverse = ltcInverseMatrix(cell, alpha, c.view.z);
  return std::abs(reference::microfacetOverPolygon(reference::Ndf::kGgx, {sine, 0, c.view.z}, alpha,
                                                   1, inverse, turned) /
                  reference::polygonSolidAngle(light));
}

// Relative to the true value, or to what the same light brings where the view mirrors it.
Finding ggxLobe(const CheckContext& context, double half_deg) {
  const double half_rad = half_deg * kDegree;
  Finding finding(kGgxTolerance);
  unsigned seed = 40;
  for (const double alpha : kGgxRoughness) {
    const std::vector<GgxCase> cases = ggxCases(alpha, half_rad, ++seed);
    const std::vector<ProbedGgx> probed = probeGgx(context, cases, alpha, half_rad);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const double want = wantedLobe(cases[i], alpha, half_rad);
      GgxCase mirrored = cases[i];
      mirrored.axis = glm::dvec3(-mirrored.view.x, -mirrored.view.y,
                                 std::max(mirrored.view.z, std::sin(half_rad) + 0.01));
      mirrored.axis = glm::normalize(mirrored.axis);
      const double most = std::max(want, wantedLobe(mirrored, alpha, half_rad));
      finding.add(std::abs(probed[i].specular - want) / most);
    }
  }
  return finding;
}

// The share of reflecting microdetails; nine of ten lights stay below the bound.
Finding ggxProbability(const CheckContext& context, double half_deg) {
  const double half_rad = half_deg * kDegree;
  Finding finding(half_deg <= 20 ? kConeProbability : kWideConeProbability);
  std::vector<double> errors;
  unsigned seed = 80;
  for (const double alpha : kGgxRoughness) {
    const std::vector<GgxCase> cases = ggxCases(alpha, half_rad, ++seed);
    const std::vector<ProbedGgx> probed = probeGgx(context, cases, alpha, half_rad);
    const reference::DetailLobes lobes{reference::Ndf::kGgx, alpha, glm::dvec2(kGgxMicro * alpha)};
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const double want =
          reference::polygonProbability(disc(cases[i].axis, half_rad), cases[i].view, lobes, 500);
      if (want < 1e-3) continue;
      const double ratio = probed[i].probability / want;
      finding.require(ratio > 1 / kProbabilityMagnitude && ratio < kProbabilityMagnitude,
                      fmt::format("a light has {:.2g} times its share", ratio));
      errors.push_back(std::abs(ratio - 1));
    }
  }
  finding.addMost(errors, 31);
  return finding;
}

// The mean over a frame of glints and of the smooth lobe, under a sun.
Finding ggxEnergy(const CheckContext& context, double half_deg) {
  Scene scene = floorScene();
  scene.materials[0].ggx = true;
  scene.lights[0].direction.w = static_cast<float>(half_deg * kDegree);
  return frameEnergy(context, scene, lookingDown(55), 0);
}

}  // namespace

std::vector<Check> ggxChecks() {
  std::vector<Check> checks;
  for (const double half_deg : {0.1, 2.0, 10.0, 40.0}) {
    checks.push_back({fmt::format("ggx/lobe_{:g}_deg", half_deg), "error over the highlight",
                      [half_deg](const CheckContext& c) { return ggxLobe(c, half_deg); }});
    checks.push_back({fmt::format("ggx/probability_{:g}_deg", half_deg),
                      "relative error of p, 9 of 10",
                      [half_deg](const CheckContext& c) { return ggxProbability(c, half_deg); }});
  }
  for (const double half_deg : {0.0, 5.0})
    checks.push_back({fmt::format("ggx/energy_{:g}_deg", half_deg), "relative error of the mean",
                      [half_deg](const CheckContext& c) { return ggxEnergy(c, half_deg); }});
  return checks;
}

}  // namespace glintmark
