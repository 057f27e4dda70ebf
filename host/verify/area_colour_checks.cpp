// Coloured surfaces under area lights, and roughness from mean normals, against the papers' own
// definitions: the microfacet BRDF with Schlick's term integrated over the light, Lambert's form
// factor, and spherical convolution.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "host/core/float4.h"
#include "host/fit/ltc_lobe.h"
#include "host/fit/meso_convolution.h"
#include "host/harness/specular_cases.h"
#include "host/reference/microfacet.h"
#include "host/reference/polygon_light.h"
#include "host/reference/scaled_cosine.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr glm::dvec3 kAreaF0(0.04, 0.5, 0.9), kAreaAlbedo(0.8, 0.3, 0.1), kRadiance(1, 3, 0.5);
constexpr double kAreaIntensity = 0.7;
// A lobe of four parameters in place of the BRDF, of unit radiance, in units of what a white one
// reflects at most: [HDHN16] Sect. 5, here at views down to 3 degrees.
constexpr double kFittedLobe = 0.03;
// An infinite light: what the table holds of the BRDF's albedo, a bilinear table of 64 x 64.
constexpr double kTableAlbedo = 3e-3;
// The same where the horizon's cut is bent, as if the transformed hemisphere were a sphere's part.
constexpr double kBentAlbedo = 0.04;
// The closed form's relative error for roughnesses from 0.001 on, as kernels/area/meso_table.h
// states it, and that of the two scales together.
constexpr double kMesoRelative = 1e-3, kMesoJoined = 6e-3;

AreaLightProbe colouredProbe(const CheckContext& context, const AreaLight& light, bool diffuse) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  probe.material.surface.f0 = toFloat4(kAreaF0);
  probe.material.surface.intensity = static_cast<float>(kAreaIntensity);
  if (diffuse) probe.material.surface.albedo = toFloat4(kAreaAlbedo);
  probe.lights = {light};
  probe.lights[0].radiance = kRadiance;
  probe.table = shippedGgx();
  probe.width = context.lanes;
  return probe;
}

// Every channel of a light that any horizon cuts: Schlick's term of each f0, the albedo, the
// radiance and the intensity.
Finding brdf(const CheckContext& context, bool diffuse) {
  const AreaLight light = specularQuad();
  const std::vector<SpecularCase> cases = specularCases(160, light, 0.1);
  std::vector<HandMadePoint> points;
  for (const SpecularCase& c : cases) points.push_back(c.point);
  const std::vector<glm::vec3> got =
      lightPoints(context.bench, colouredProbe(context, light, diffuse), points);
  Finding finding(kFittedLobe);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double cosine = glm::dot(cases[i].point.view, cases[i].point.normal);
    const glm::dvec3 view(std::sqrt(1 - cosine * cosine), 0, cosine);
    const std::vector<glm::dvec3> above = reference::clipPolygon(cases[i].local, {0, 0, 1});
    // The matrix places the rule's points; any that fits roughly gives the same integral.
    const glm::dmat3 inverse = ltcInverseMatrix(
        lookUpLtc(shippedGgx(), cases[i].point.alpha, cosine), cases[i].point.alpha, cosine);
    for (int c = 0; c < 3; ++c) {
      double want = 0;
      if (!above.empty()) {
        want = kAreaIntensity *
               std::abs(reference::microfacetOverPolygon(
                   reference::Ndf::kGgx, view, cases[i].point.alpha, kAreaF0[c], inverse, above));
        if (diffuse) want += kAreaAlbedo[c] * std::abs(reference::polygonFormFactor(above));
      }
      finding.add(std::abs(got[i][c] / kRadiance[c] - want));
    }
  }
  return finding;
}

// Directional albedo under Schlick's term, by the midpoint rule over the quantiles of GGX's facets:
// slopes of length alpha sqrt(u / (1 - u)).
double schlickAlbedo(double alpha, double cosine, double f0) {
  constexpr int kSteps = 400;
  const glm::dvec3 o(std::sqrt(1 - cosine * cosine), 0, cosine);
  double sum = 0;
  for (int a = 0; a < kSteps; ++a)
    for (int b = 0; b < kSteps; ++b) {
      const double u = (a + 0.5) / kSteps, phi = std::numbers::pi * (b + 0.5) / kSteps;
      const double slope = alpha * std::sqrt(u / (1 - u));
      const glm::dvec3 m =
          glm::normalize(glm::dvec3(slope * std::cos(phi), slope * std::sin(phi), 1));
      const double facing = glm::dot(o, m);
      const glm::dvec3 i = 2 * facing * m - o;
      if (facing <= 0 || i.z <= 0) continue;
      // BRDF cos over its density D m.z / (4 o.m).
      const double value = reference::microfacetTimesCosine(reference::Ndf::kGgx, i, o, alpha) * 4 *
                           facing /
                           (reference::microfacetDensity(reference::Ndf::kGgx, m, alpha) * m.z);
      sum += value * (f0 + (1 - f0) * std::pow(1 - facing, 5));
    }
  return sum / (kSteps * kSteps);
}

// A light that fills the hemisphere shows the table's columns, whole lobes or clipped.
Finding albedos(const CheckContext& context, bool clipless) {
  const AreaLight light =
      polygonLight(rectangleVertices({0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {2e5, 2e5}));
  AreaLightProbe probe = colouredProbe(context, light, false);
  probe.clipless = clipless;
  Finding finding(clipless ? kBentAlbedo : kTableAlbedo);
  for (const double alpha : {0.1, 0.3, 0.7})
    for (const double cosine : {1.0, 0.6, 0.3, 0.15}) {
      HandMadePoint point;
      point.alpha = alpha;
      point.view = {std::sqrt(1 - cosine * cosine), 0, cosine};
      const glm::vec3 got = lightPoints(context.bench, probe, {point})[0];
      for (int c = 0; c < 3; ++c)
        finding.add(std::abs(got[c] / (kAreaIntensity * kRadiance[c]) -
                             schlickAlbedo(alpha, cosine, kAreaF0[c])));
    }
  return finding;
}

// The same of the whole lobe: what Schlick's term leaves of it, which the horizon's bend does not
// touch.
Finding wholeLobes(const CheckContext& context) {
  const AreaLight light =
      polygonLight(rectangleVertices({0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {2e5, 2e5}));
  AreaLightProbe probe = colouredProbe(context, light, false), white = probe;
  probe.clipless = white.clipless = true;
  white.material.surface.f0 = {1, 1, 1, 0};
  Finding finding(kTableAlbedo);
  for (const double alpha : {0.1, 0.3, 0.7})
    for (const double cosine : {1.0, 0.6, 0.3, 0.15}) {
      HandMadePoint point;
      point.alpha = alpha;
      point.view = {std::sqrt(1 - cosine * cosine), 0, cosine};
      const glm::vec3 got = lightPoints(context.bench, probe, {point})[0] /
                            lightPoints(context.bench, white, {point})[0];
      for (int c = 0; c < 3; ++c)
        finding.add(std::abs(got[c] - schlickAlbedo(alpha, cosine, kAreaF0[c]) /
                                          schlickAlbedo(alpha, cosine, 1)));
    }
  return finding;
}

// Method exact: alpha_me is the roughness whose lobe has that mean length ([TAO21] Eq. 4), and both
// scales together are the lobe nearest to their convolution (Eq. 6).
Finding exactMeso(const CheckContext& context) {
  Finding finding(1);
  std::vector<float> lengths;
  for (double alpha = 0.002; alpha < 0.98; alpha *= 1.15)
    lengths.push_back(static_cast<float>(reference::meanResultantLength(alpha)));
  const auto meso =
      footprintAlphas(context.bench, LtcMethod::kExact, 1e-6f, lengths, context.lanes);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    finding.add(std::abs(meso[i] / reference::alphaOfMeanLength(lengths[i]) - 1) /
                (kMesoRelative + 1e-6 / (1 - lengths[i])));  // lengths are floats
  const std::vector<double> alphas = {0.1, 0.3, 0.5, 0.8};
  const MesoConvolution convolution(alphas);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const auto at = [&](int k) { return alphas[static_cast<std::size_t>(k)]; };
      const std::vector<float> length = {static_cast<float>(reference::meanResultantLength(at(j)))};
      const double got = footprintAlphas(context.bench, LtcMethod::kExact,
                                         static_cast<float>(at(i)), length, context.lanes)[0];
      finding.add(std::abs(got - std::min(convolution.closest(i, j).alpha, 1.0)) / kMesoJoined);
    }
  return finding;
}

}  // namespace

std::vector<Check> areaColourChecks() {
  return {{"area_light/coloured", "error of what is reflected",
           [](const CheckContext& context) { return brdf(context, false); }},
          {"area_light/coloured_diffuse", "error of what is reflected",
           [](const CheckContext& context) { return brdf(context, true); }},
          {"area_light/schlick_albedo", "error of the albedo",
           [](const CheckContext& context) { return albedos(context, false); }},
          {"area_light/schlick_albedo_clipless", "error of the albedo",
           [](const CheckContext& context) { return albedos(context, true); }},
          {"area_light/schlick_of_whole_lobes", "error of its share", wholeLobes},
          {"area_light/exact_mean_normal", "error in units of its bound", exactMeso}};
}

}  // namespace glintmark
