// Polygon lights over transformed cosines: against the double-precision lobe, at every horizon.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/fit/ltc_lobe.h"
#include "host/harness/specular_cases.h"
#include "host/harness/tolerances.h"
#include "host/reference/polygon_light.h"
#include "host/reference/scaled_cosine.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

// Against the lobe in double precision. `cut_twice`: how many of the lights, at least, must shine
// and be cut at the surface's horizon and at the cosine's own.
Finding sameLobe(const CheckContext& context, const AreaLight& light, int cut_twice) {
  const std::vector<SpecularCase> cases = specularCases(1024, light, 0.01);
  const std::vector<glm::vec3> values = shadeSpecular(context.bench, light, cases, context.lanes);
  Finding finding(kSameLobe);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double cosine = glm::dot(cases[i].point.view, cases[i].point.normal);
    const LtcCell cell = lookUpLtc(shippedGgx(), cases[i].point.alpha, cosine);
    const glm::dmat3 inverse = ltcInverseMatrix(cell, cases[i].point.alpha, cosine);
    const std::vector<glm::dvec3> clipped = reference::clipPolygon(cases[i].local, {0, 0, 1});
    const double exact =
        clipped.empty() ? 0 : cell.scale * std::abs(reference::ltcOverPolygon(inverse, clipped));
    finding.add(std::abs(values[i].x - exact));
    const auto below = [](const glm::dvec3& v) { return v.z < 0; };
    const auto below_cosine = [&](const glm::dvec3& v) { return (inverse * v).z < -1e-3; };
    cut_twice -= exact > 0.01 && std::ranges::any_of(cases[i].local, below) &&
                 std::ranges::any_of(clipped, below_cosine);
  }
  finding.require(cut_twice <= 0, "too few lights are cut at both horizons");
  return finding;
}

Finding kernelIsTheLobe(const CheckContext& context) {
  return sameLobe(context, specularQuad(), 0);
}

Finding twoHorizons(const CheckContext& context) {
  return sameLobe(context,
                  polygonLight({{-5, -4, 0}, {4, -5, 0}, {6, 3, 0}, {0, 6, 0}, {-5, 2, 0}}, true),
                  100);
}

Finding hemisphereAlbedo(const CheckContext& context) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  probe.table = shippedGgx();
  probe.width = context.lanes;
  probe.lights = {polygonLight(rectangleVertices({0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {2e5, 2e5}))};
  Finding finding(kHemisphereAlbedo);
  for (const double alpha : {0.03, 0.3, 1.0})
    for (const double cosine : {1.0, 0.6, 0.2}) {
      HandMadePoint point;
      point.alpha = alpha;
      point.view = {std::sqrt(1 - cosine * cosine), 0, cosine};
      finding.add(std::abs(lightPoints(context.bench, probe, {point})[0].x -
                           lookUpLtc(shippedGgx(), alpha, cosine).albedo));
    }
  return finding;
}

Finding samePoints(const CheckContext& context) {
  const AreaLight light = specularQuad();
  const std::vector<SpecularCase> cases = specularCases(500, light, 1e-3);
  const auto one = shadeSpecular(context.bench, light, cases, 1),
             wide = shadeSpecular(context.bench, light, cases, context.lanes);
  double different = 0;
  for (std::size_t i = 0; i < one.size(); ++i) different += one[i] != wide[i];
  Finding finding(0);
  finding.add(different);
  return finding;
}

// --- Hard lights ---------------------------------------------------------------------------------

struct HardLight {
  const char* name;
  std::vector<glm::dvec3> vertices;
};

const std::vector<HardLight>& hardLights() {
  static const std::vector<HardLight> lights = {
      {"crosses_horizon", {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}},
      {"below", {{1, -1, -1}, {1, 1, -1}, {1, 1, -2}, {1, -1, -2}}},
      {"edge_on", {{1, 0, 0.5}, {2, 0, 0.5}, {2, 0, 1.5}, {1, 0, 1.5}}},
      {"in_the_surface", {{1, -1, 0}, {2, -1, 0}, {2, 1, 0}, {1, 1, 0}}},
      {"around_the_point", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}},
      {"vertex_at_the_point", {{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0}}},
      {"edge_through_the_point", {{-1, 0, 0}, {1, 0, 0}, {1, 0.1, 1}, {-1, 0.1, 1}}},
      {"touches_the_surface", {{-1, 1, 0}, {1, 1, 0}, {1, 1, 1}, {-1, 1, 1}}},
      {"a_hair_above",
       {{-1e4, -1e4, 1e-6}, {-1e4, 1e4, 1e-6}, {1e4, 1e4, 1e-6}, {1e4, -1e4, 1e-6}}},
      {"a_line", {{-1, 0, 1}, {1, 0, 1}, {1, 1e-7, 1}, {-1, 1e-7, 1}}},
      {"1e-10_sr", {{0, 0, 1}, {1e-5, 0, 1}, {1e-5, 1e-5, 1}, {0, 1e-5, 1}}},
      {"far_away", {{1e6, 0, 1e6}, {1e6, 1e3, 1e6}, {1e6, 1e3, 1.001e6}, {1e6, 0, 1.001e6}}},
      {"a_sliver", {{-1e3, 0, 0.1}, {1e3, 0, 0.1}, {1e3, 1e-3, 0.1}, {-1e3, 1e-3, 0.1}}}};
  return lights;
}

// From straight down to below the surface, 0.1 degrees above it among them.
std::vector<HandMadePoint> hardViews() {
  std::vector<HandMadePoint> points;
  for (const double alpha : {0.001, 0.01, 0.1, 1.0})
    for (const double angle_deg : {90.0, 89.9999, 45.0, 1.0, 0.1, -5.0})
      for (const double azimuth : {0.0, 1.0, 4.0}) {
        HandMadePoint p;
        const double angle = angle_deg * std::numbers::pi / 180;
        p.view = {std::cos(angle) * std::cos(azimuth), std::cos(angle) * std::sin(azimuth),
                  std::sin(angle)};
        p.alpha = alpha;
        points.push_back(p);
      }
  return points;
}

// Finite, never negative, never more than the light's radiance. The worst is what is reflected.
Finding hardLight(const CheckContext& context, const HardLight& light) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  probe.material.surface.albedo = {1, 1, 1, 0};
  probe.table = shippedGgx();
  probe.lights = {polygonLight(light.vertices, true)};
  probe.width = context.lanes;
  Finding finding(kMostReflected);
  for (const bool clipless : {false, true}) {
    probe.clipless = clipless;
    for (const glm::vec3& value : lightPoints(context.bench, probe, hardViews())) {
      finding.add(value.x);
      finding.require(std::isfinite(value.x) && value.x >= 0, fmt::format("radiance {}", value.x));
    }
  }
  return finding;
}

// --- Roughness from mean normals -----------------------------------------------------------------

// Lengths of mean normals from 0 to beyond 1: the polynomials as printed; the closed form never
// smoother than the material, never rougher than 1, smoother the longer the mean.
Finding meanNormals(const CheckContext& context) {
  std::vector<float> lengths;
  for (float length = 0; length <= 1.0005f; length += 0.0005f) lengths.push_back(length);
  Finding finding(kMesoAlpha);
  for (const float micro : {0.001f, 0.03f, 0.3f, 1.0f}) {
    const auto tao21 =
        footprintAlphas(context.bench, LtcMethod::kTao21, micro, lengths, context.lanes);
    const auto exact =
        footprintAlphas(context.bench, LtcMethod::kExact, micro, lengths, context.lanes);
    const auto original =
        footprintAlphas(context.bench, LtcMethod::kOriginal, micro, lengths, context.lanes);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      finding.add(std::abs(
          tao21[i] - reference::tao21OverallAlpha(micro, reference::tao21MesoAlpha(lengths[i]))));
      finding.require(original[i] == micro, "the original method changes the roughness");
      finding.require(exact[i] >= micro && exact[i] <= 1, fmt::format("alpha {}", exact[i]));
      finding.require(i == 0 || lengths[i] >= 1 || exact[i] <= exact[i - 1] + 1e-6f,
                      "a longer mean is rougher");
    }
    finding.require(exact.back() == micro, "a mean normal of length 1 changes the roughness");
    finding.require(exact == footprintAlphas(context.bench, LtcMethod::kExact, micro, lengths, 1),
                    "lanes differ from one lane");
  }
  return finding;
}

}  // namespace

std::vector<Check> areaLightChecks() {
  std::vector<Check> checks = {
      {"area_light/kernel_is_the_lobe", "absolute error", kernelIsTheLobe},
      {"area_light/two_horizons", "absolute error", twoHorizons},
      {"area_light/hemisphere_albedo", "absolute error", hemisphereAlbedo},
      {"area_light/mean_normal_0_to_1", "error of alpha", meanNormals},
      {"area_light/same_bits", "points that differ from one lane's", samePoints}};
  for (const HardLight& light : hardLights())
    checks.push_back({std::string("hard_light/") + light.name, "most that is reflected",
                      [&light](const CheckContext& context) { return hardLight(context, light); }});
  return checks;
}

}  // namespace glintmark
