// Anisotropic surfaces under area lights: against the same lobe in double precision, against the
// BRDF's own integral, against round lobes where they are round, and at the ends of their range.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/fit/anisotropic_table.h"
#include "host/harness/specular_cases.h"
#include "host/harness/tolerances.h"
#include "host/reference/ltc.h"
#include "host/reference/polygon_light.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

const AnisotropicTable& stretchedGgx() {
  static const AnisotropicTable table = shippedAnisotropicTable(reference::Ndf::kGgx);
  return table;
}

std::vector<glm::vec3> shadeStretched(const CheckContext& context, const AreaLight& light,
                                      const std::vector<HandMadePoint>& points, int lanes) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  probe.lights = {light};
  probe.table = shippedGgx();
  probe.anisotropic = &stretchedGgx();
  probe.width = lanes;
  return lightPoints(context.bench, probe, points);
}

std::vector<HandMadePoint> pointsOf(const std::vector<SpecularCase>& cases) {
  std::vector<HandMadePoint> points;
  points.reserve(cases.size());
  for (const SpecularCase& c : cases) points.push_back(c.point);
  return points;
}

// Random points whose roughness along a random axis is `ratio` times that across it.
std::vector<SpecularCase> stretchedCases(int count, const AreaLight& light, double ratio,
                                         double least_cosine) {
  std::vector<SpecularCase> cases;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform;
  for (SpecularCase c : specularCases(3 * count, light, 0.05)) {
    if (static_cast<int>(cases.size()) == count) break;
    if (glm::dot(c.point.view, c.point.normal) < least_cosine) continue;
    c.point.alpha_across = std::max(c.point.alpha / ratio, 2e-4);
    const double angle = 2 * std::numbers::pi * uniform(random);
    const glm::dvec3 n = c.point.normal;
    const glm::dvec3 x = glm::normalize(std::abs(n.x) < 0.6 ? glm::cross(n, glm::dvec3(1, 0, 0))
                                                            : glm::cross(n, glm::dvec3(0, 1, 0)));
    c.point.axis = glm::dvec3(glm::vec3(std::cos(angle) * x + std::sin(angle) * glm::cross(n, x)));
    cases.push_back(c);
  }
  return cases;
}

// The axes of a point's surface: u, v and normal, as columns.
glm::dmat3 axesOf(const HandMadePoint& p) {
  const glm::dvec3 u = glm::normalize(p.axis - glm::dot(p.axis, p.normal) * p.normal);
  return {u, glm::cross(p.normal, u), p.normal};
}

// Folded into the quarter turn that the table has; `mirrored`: as its mirror image.
AnisotropicView viewOf(const HandMadePoint& p, bool* mirrored) {
  const glm::dvec3 o = glm::transpose(axesOf(p)) * p.view;
  *mirrored = o.x * o.y < 0;
  return {.ndf = reference::Ndf::kGgx,
          .alpha = {p.alpha, p.alpha_across},
          .cos_theta = o.z,
          .phi_rad = std::atan2(std::abs(o.y), std::abs(o.x))};
}

Finding kernelIsTheStretchedLobe(const CheckContext& context) {
  const AreaLight light = specularQuad();
  Finding finding(kSameLobe);
  for (const double ratio : {1.0, 3.0, 10.0, 1000.0}) {
    const std::vector<SpecularCase> cases = stretchedCases(256, light, ratio, 0.05);
    const auto values = shadeStretched(context, light, pointsOf(cases), context.lanes);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      bool mirrored = false;
      const AnisotropicView view = viewOf(cases[i].point, &mirrored);
      const AnisotropicCell cell = lookUpAnisotropic(stretchedGgx(), view);
      const glm::dmat3 inverse = glm::inverse(anisotropicMatrix(cell, view));
      std::vector<glm::dvec3> local = cases[i].local;
      for (glm::dvec3& v : local) v.y = mirrored ? -v.y : v.y;
      const std::vector<glm::dvec3> clipped = reference::clipPolygon(local, {0, 0, 1});
      const double exact = clipped.empty()
                               ? 0
                               : cell.albedo / reference::ltcMassAboveHorizon(inverse) *
                                     std::abs(reference::ltcOverPolygon(inverse, clipped));
      finding.add(std::abs(values[i].x - exact));
    }
  }
  return finding;
}

Finding roundByStretched(const CheckContext& context, bool worst) {
  const AreaLight light = specularQuad();
  const std::vector<SpecularCase> cases = stretchedCases(512, light, 1, 0.26);
  const auto stretched = shadeStretched(context, light, pointsOf(cases), context.lanes);
  const auto round = shadeSpecular(context.bench, light, cases, context.lanes);
  Finding finding(worst ? kRoundByStretched : kRoundByStretchedMean);
  double sum = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double error = std::abs(stretched[i].x - round[i].x);
    if (worst) finding.add(error);
    sum += error;
  }
  if (!worst) finding.add(sum / static_cast<double>(cases.size()));
  return finding;
}

// What the BRDF itself reflects of a polygon: mirror images of facets drawn on a grid from D(m)
// m.z.
double brdfOverPolygon(const HandMadePoint& p, const std::vector<glm::dvec3>& vertices) {
  constexpr int kRadii = 96, kTurns = 192;
  const glm::dmat3 to_surface = glm::transpose(axesOf(p));
  const glm::dvec3 o = to_surface * p.view;
  const glm::dvec2 alpha(p.alpha, p.alpha_across);
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3& v : vertices) corners.push_back(to_surface * (v - p.position));
  double sum = 0;
  for (int i = 0; i < kRadii; ++i)
    for (int j = 0; j < kTurns; ++j) {
      // Turned by the golden section from ring to ring, so that edges meet no pattern.
      const double u = (i + 0.5) / kRadii, turn = (j + 0.5) / kTurns + 0.618033988749895 * i;
      const double slope = std::sqrt(u / (1 - u));
      const glm::dvec3 m =
          glm::normalize(glm::dvec3(alpha.x * slope * std::cos(2 * std::numbers::pi * turn),
                                    alpha.y * slope * std::sin(2 * std::numbers::pi * turn), 1));
      const double facing = glm::dot(o, m);
      if (facing <= 0) continue;
      const glm::dvec3 l = 2 * facing * m - o;
      int inside = 0;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 normal = glm::cross(corners[k], corners[(k + 1) % corners.size()]);
        inside += glm::dot(normal, l) > 0 ? 1 : -1;
      }
      if (std::abs(inside) != static_cast<int>(corners.size())) continue;
      if (glm::dot(l, corners[0] + corners[2]) <= 0) continue;
      sum += reference::microfacetTimesCosine(reference::Ndf::kGgx, l, o, alpha) * 4 * facing /
             (reference::microfacetDensity(reference::Ndf::kGgx, m, alpha) * m.z);
    }
  return sum / (kRadii * kTurns);
}

Finding againstTheBrdf(const CheckContext& context, double ratio, double bound) {
  const AreaLight light = specularQuad();
  const std::vector<SpecularCase> cases = stretchedCases(400, light, ratio, 0.15);
  const auto values = shadeStretched(context, light, pointsOf(cases), context.lanes);
  double error = 0, reflected = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double exact = brdfOverPolygon(cases[i].point, light.vertices);
    error += std::abs(values[i].x - exact);
    reflected += exact;
  }
  Finding finding(bound);
  finding.add(error / reflected);
  return finding;
}

// The longer axis named second, or turned by half a turn: the same surface.
Finding swappedAxes(const CheckContext& context) {
  const AreaLight light = specularQuad();
  Finding finding(kSameLobe);
  const std::vector<SpecularCase> cases = stretchedCases(256, light, 7, 0.05);
  const std::vector<HandMadePoint> points = pointsOf(cases);
  std::vector<HandMadePoint> swapped = points, turned = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::swap(swapped[i].alpha, swapped[i].alpha_across);
    swapped[i].axis = axesOf(points[i])[1];
    turned[i].axis = -points[i].axis;
  }
  const auto wanted = shadeStretched(context, light, points, context.lanes);
  const auto first = shadeStretched(context, light, swapped, context.lanes);
  const auto second = shadeStretched(context, light, turned, context.lanes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    finding.add(std::abs(first[i].x - wanted[i].x));
    finding.add(std::abs(second[i].x - wanted[i].x));
  }
  return finding;
}

// Under a light that fills the hemisphere: the BRDF's albedo.
Finding stretchedAlbedo(const CheckContext& context) {
  const AreaLight light =
      polygonLight(rectangleVertices({0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {2e5, 2e5}));
  Finding finding(kStretchedAlbedo);
  std::vector<HandMadePoint> points;
  for (const double alpha : {0.1, 0.4, 0.9})
    for (const double ratio : {1.0, 2.0, 10.0, 1000.0})
      for (const double cosine : {1.0, 0.6, 0.2})
        for (const double azimuth : {0.0, 0.7, 1.5, 2.5}) {
          HandMadePoint p;
          p.alpha = alpha;
          p.alpha_across = alpha / ratio;
          const double sine = std::sqrt(1 - cosine * cosine);
          p.view = {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
          points.push_back(p);
        }
  const auto values = shadeStretched(context, light, points, context.lanes);
  const std::vector<glm::dvec3> all = {
      {-1e6, -1e6, 1}, {-1e6, 1e6, 1}, {1e6, 1e6, 1}, {1e6, -1e6, 1}};
  for (std::size_t i = 0; i < points.size(); ++i)
    finding.add(std::abs(values[i].x - brdfOverPolygon(points[i], all)));
  return finding;
}

// Straight down no azimuth is any other: views a hair off the normal all around see one lobe.
Finding alongTheNormal(const CheckContext& context) {
  const AreaLight light = specularQuad();
  Finding finding(kStraightDown);
  for (const double tilt : {0.0, 1e-7, 1e-4}) {
    std::vector<HandMadePoint> points;
    for (int k = 0; k < 32; ++k) {
      HandMadePoint p;
      p.position = {0.2, 0.1, -1.5};
      const double azimuth = 2 * std::numbers::pi * k / 32;
      p.view = glm::normalize(glm::dvec3(tilt * std::cos(azimuth), tilt * std::sin(azimuth), 1));
      p.alpha = 0.4;
      p.alpha_across = 0.05;
      p.axis = {std::cos(0.3), std::sin(0.3), 0};
      points.push_back(p);
    }
    const auto values = shadeStretched(context, light, points, context.lanes);
    for (const glm::vec3& value : values) finding.add(std::abs(value.x - values[0].x));
  }
  return finding;
}

// Ratios up to 1000, from straight down to below the surface: finite, never negative, never more
// than the light.
Finding hardStretched(const CheckContext& context) {
  Finding finding(kMostReflected);
  for (const AreaLight& light :
       {polygonLight({{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}, true),
        polygonLight({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, true),
        polygonLight({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, true)}) {
    std::vector<HandMadePoint> points;
    for (const double alpha : {0.001, 0.1, 1.0})
      for (const double ratio : {1.0, 10.0, 1000.0, 1e6})
        for (const double angle_deg : {90.0, 89.9999, 45.0, 1.0, 0.1, 0.0, -5.0})
          for (const double azimuth : {0.0, 0.5, std::numbers::pi / 2, 4.0}) {
            HandMadePoint p;
            const double angle = angle_deg * std::numbers::pi / 180;
            p.view = {std::cos(angle) * std::cos(azimuth), std::cos(angle) * std::sin(azimuth),
                      std::sin(angle)};
            p.alpha = alpha;
            p.alpha_across = alpha / ratio;
            points.push_back(p);
          }
    for (const glm::vec3& value : shadeStretched(context, light, points, context.lanes)) {
      finding.add(value.x);
      finding.require(std::isfinite(value.x) && value.x >= 0, fmt::format("radiance {}", value.x));
    }
  }
  return finding;
}

Finding sameStretchedPoints(const CheckContext& context) {
  const AreaLight light = specularQuad();
  const std::vector<HandMadePoint> points = pointsOf(stretchedCases(250, light, 20, 0.05));
  const auto one = shadeStretched(context, light, points, 1),
             wide = shadeStretched(context, light, points, context.lanes);
  double different = 0;
  for (std::size_t i = 0; i < one.size(); ++i) different += one[i] != wide[i];
  Finding finding(0);
  finding.add(different);
  return finding;
}

}  // namespace

std::vector<Check> anisotropicChecks() {
  std::vector<Check> checks = {
      {"anisotropic/kernel_is_the_lobe", "absolute error", kernelIsTheStretchedLobe},
      {"anisotropic/round_mean", "mean difference from round lobes",
       [](const CheckContext& context) { return roundByStretched(context, false); }},
      {"anisotropic/round_worst", "difference from round lobes",
       [](const CheckContext& context) { return roundByStretched(context, true); }},
      {"anisotropic/swapped_axes", "difference", swappedAxes},
      {"anisotropic/hemisphere_albedo", "absolute error", stretchedAlbedo},
      {"anisotropic/along_the_normal", "difference between azimuths", alongTheNormal},
      {"anisotropic/hard", "most that is reflected", hardStretched},
      {"anisotropic/same_bits", "points that differ from one lane's", sameStretchedPoints}};
  for (const auto& [ratio, bound] : {std::pair{2.0, kStretched2},
                                     {5.0, kStretched5},
                                     {10.0, kStretched10},
                                     {1000.0, kStretched1000}})
    checks.push_back({fmt::format("anisotropic/brdf_1_to_{:.0f}", ratio), "mean error of the mean",
                      [ratio = ratio, bound = bound](const CheckContext& context) {
                        return againstTheBrdf(context, ratio, bound);
                      }});
  return checks;
}

}  // namespace glintmark
