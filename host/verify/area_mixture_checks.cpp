// Mixtures of normals under area lights: against Monte Carlo over their normals, and at their
// limits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/harness/area_mixture_harness.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

// One cosine lobe for a Gaussian of normals: the error that nine in ten lights stay below, in units
// of what a light that fills the view would send, and that of all of them together.
constexpr double kLobeOfNormals = 0.036, kSchlickOfNormals = 0.009, kEnergyOfNormals = 0.03;
// The same at grazing views, where lobes are no cosines.
constexpr double kGrazingNormals = 0.044, kGrazingEnergy = 0.1;
// Lambert's term of the mean normal for that of all: what bends at the horizon is left out.
constexpr double kMeanCosine = 0.015;
constexpr int kNormals = 20000, kMixtures = 120;

MaterialParams mixtureMaterial(double alpha) {
  MaterialParams material = whiteSpecular();
  material.surface.alpha_g = {static_cast<float>(alpha), static_cast<float>(alpha)};
  return material;
}

AreaLight panel() {
  return polygonLight({{-1, -0.7, 0}, {1, -0.7, 0}, {1, 0.7, 0}, {-1, 0.7, 0}}, true);
}

// Points around the panel that see it near where their normals mirror the view, lobes of any width
// and of tilts up to 40 degrees.
std::vector<MixturePoint> randomMixtures(int lobes, double least_deviation, double most_deviation,
                                         double least_z = 0.17, double most_z = 1,
                                         double most_tilt = 0.6) {
  std::mt19937 random(23);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit;
  std::vector<MixturePoint> points;
  while (points.size() < kMixtures) {
    MixturePoint p;
    const double z = least_z + (most_z - least_z) * unit(random), turn = 2 * kPi * unit(random);
    p.view = {std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z};
    for (int k = 0; k < lobes; ++k) {
      const double tilt = most_tilt * std::sqrt(unit(random)), side = 2 * kPi * unit(random);
      p.lobes.push_back({1.0 / lobes,
                         {tilt * std::cos(side), tilt * std::sin(side)},
                         least_deviation + (most_deviation - least_deviation) * unit(random)});
    }
    const glm::dvec2 m = p.lobes[0].mean;
    const glm::dvec3 n(m, std::sqrt(1 - glm::dot(m, m)));
    const double facing = glm::dot(n, p.view);
    glm::dvec3 to_light = 2 * facing * n - p.view;
    to_light += 0.4 * glm::dvec3(normal(random), normal(random), normal(random));
    p.position = -(1 + 2 * unit(random)) * glm::normalize(to_light);
    if (facing < 0.1 || p.position.z > -0.5) continue;
    points.push_back(p);
  }
  return points;
}

std::vector<glm::dvec3> localPanel(const MixturePoint& point, const AreaLight& light) {
  std::vector<glm::dvec3> vertices;
  for (const glm::dvec3& v : light.vertices) vertices.push_back(v - point.position);
  return vertices;
}

enum class Term { kSpecular, kSchlick, kDiffuse, kGrazing };

Finding monteCarlo(const CheckContext& context, int lobes, double alpha, Term term) {
  const AreaLight light = panel();
  const bool grazing = term == Term::kGrazing;  // views from 8 to 17 degrees, wide lobes
  const std::vector<MixturePoint> points = grazing
                                               ? randomMixtures(lobes, 0.2, 0.25, 0.14, 0.3, 0.05)
                                               : randomMixtures(lobes, 0.02, 0.25);
  MaterialParams material = mixtureMaterial(alpha);
  if (term == Term::kSchlick) material.surface.f0 = {0, 0, 0, 0};
  if (term == Term::kDiffuse) {
    material.surface.intensity = 0;
    material.surface.albedo = {1, 1, 1, 0};
  }
  const std::vector<glm::vec3> got =
      lightMixtures(context.bench, material, {light}, points, context.lanes);
  std::vector<double> errors;
  double sum = 0, exact_sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const reference::MixtureReflection exact =
        reference::mixtureOverPolygon(reference::Ndf::kGgx, points[i].view, alpha, points[i].lobes,
                                      localPanel(points[i], light), kNormals / lobes);
    const double expected = term == Term::kSpecular || grazing ? exact.specular
                            : term == Term::kSchlick           ? exact.schlick
                                                               : exact.diffuse;
    errors.push_back(std::abs(got[i].x - expected));
    sum += got[i].x;
    exact_sum += expected;
  }
  Finding finding(grazing                   ? kGrazingNormals
                  : term == Term::kSpecular ? kLobeOfNormals
                  : term == Term::kSchlick  ? kSchlickOfNormals
                                            : kMeanCosine);
  finding.addMost(errors, errors.size());
  const double bias = sum / exact_sum - 1;
  // Schlick's term has one factor for a lobe that it brightens on its far side only.
  finding.require(
      term == Term::kSchlick || std::abs(bias) < (grazing ? kGrazingEnergy : kEnergyOfNormals),
      fmt::format("all together {:+.3f}", bias));
  return finding;
}

// --- Limits --------------------------------------------------------------------------------------

// Normals that do not scatter are the base lobe, each with its weight: two of opposite slopes too.
Finding noVariance(const CheckContext& context, int lobes) {
  const double alpha = 0.15;
  std::vector<MixturePoint> points = randomMixtures(lobes, 0, 0);
  AreaLightProbe probe;
  probe.material = mixtureMaterial(alpha);
  probe.material.surface.f0 = {0.3f, 0.5f, 0.9f, 0};
  probe.table = shippedLtcTable(reference::Ndf::kGgx);
  probe.width = context.lanes;
  probe.lights = {panel()};
  std::vector<HandMadePoint> singles;
  for (MixturePoint& p : points) {
    if (lobes == 2) p.lobes[1].mean = -p.lobes[0].mean;
    for (const reference::GaussianOfNormals& lobe : p.lobes) {
      const glm::dvec3 n(lobe.mean, std::sqrt(1 - glm::dot(lobe.mean, lobe.mean)));
      singles.push_back({p.position, n, p.view, alpha});
    }
  }
  const std::vector<glm::vec3> got =
      lightMixtures(context.bench, probe.material, probe.lights, points, context.lanes);
  const std::vector<glm::vec3> single = lightPoints(context.bench, probe, singles);
  Finding finding(kSameLobe);
  for (std::size_t i = 0; i < points.size(); ++i) {
    glm::vec3 mean(0);
    bool judged = true;
    for (int k = 0; k < lobes; ++k) {
      const std::size_t at = i * static_cast<std::size_t>(lobes) + static_cast<std::size_t>(k);
      mean += single[at] / static_cast<float>(lobes);
      // Lobes that the base lobe hides are merged, those that turn away do not shine.
      judged = judged && glm::dot(singles[at].normal, singles[at].view) > 0 &&
               (lobes == 1 || glm::length(points[i].lobes[0].mean) > 0.1);
    }
    if (!judged) continue;
    for (int c = 0; c < 3; ++c) finding.add(std::abs(got[i][c] - mean[c]));
  }
  return finding;
}

struct HardMixture {
  const char* name;
  std::vector<reference::GaussianOfNormals> lobes;
  std::vector<glm::dvec3> light;
};

const std::vector<HardMixture>& hardMixtures() {
  const std::vector<glm::dvec3> above = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  const std::vector<glm::dvec3> through = {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}};
  const std::vector<glm::dvec3> around = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  static const std::vector<HardMixture> cases = {
      {"no_variance", {{1, {0.3, 0.1}, 0}}, above},
      {"opposite_slopes", {{0.5, {0.7, 0}, 1e-3}, {0.5, {-0.7, 0}, 1e-3}}, above},
      {"tilt_to_the_horizon", {{1, {0.999, 0}, 0.05}}, above},
      {"everything_at_once", {{1, {0, 0}, 0.6}}, above},
      {"weight_0", {{1, {0.1, 0}, 0.1}, {0, {0, 0}, 0}}, above},
      {"light_through_surface", {{0.5, {0.5, 0}, 0.2}, {0.5, {-0.5, 0}, 0.01}}, through},
      {"light_around_the_point", {{1, {0.2, 0.2}, 0.2}}, around}};
  return cases;
}

// Finite, never negative, never more than the light's radiance for each lobe; the same bits on one
// lane. The worst is what is reflected.
Finding hardMixture(const CheckContext& context, const HardMixture& hard) {
  std::vector<MixturePoint> points;
  for (const double angle_deg : {90.0, 45.0, 10.0, 0.1, -5.0})
    for (const double azimuth : {0.0, 1.0, 3.14159}) {
      const double angle = angle_deg * kDegree;
      points.push_back({{0, 0, 0},
                        {std::cos(angle) * std::cos(azimuth), std::cos(angle) * std::sin(azimuth),
                         std::sin(angle)},
                        hard.lobes});
    }
  Finding finding(kMostReflected);
  for (const double alpha : {1e-3, 0.1, 1.0}) {
    MaterialParams material = mixtureMaterial(alpha);
    material.surface.albedo = {1, 1, 1, 0};
    const std::vector<AreaLight> lights = {polygonLight(hard.light, true)};
    const auto got = lightMixtures(context.bench, material, lights, points, context.lanes);
    for (const glm::vec3& value : got) {
      finding.add(value.x);
      finding.require(std::isfinite(value.x) && value.x >= 0, fmt::format("radiance {}", value.x));
    }
    finding.require(got == lightMixtures(context.bench, material, lights, points, 1),
                    "lanes differ from one lane");
  }
  return finding;
}

// Normals that turn from the eye do not shine, whatever the light does.
Finding turnedAway(const CheckContext& context) {
  MixturePoint point;
  point.view = {std::cos(0.1), 0, std::sin(0.1)};
  point.lobes = {{1, {-0.6, 0}, 0.05}};
  Finding finding(1e-4);
  for (const glm::vec3& value :
       lightMixtures(context.bench, mixtureMaterial(0.1),
                     {polygonLight(rectangleVertices({0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {9, 9}))},
                     {point}, context.lanes))
    finding.add(value.x);
  return finding;
}

}  // namespace

std::vector<Check> areaMixtureChecks() {
  const char* measure = "absolute error, nine in ten";
  std::vector<Check> checks = {
      {"area_mixture/one_lobe", measure,
       [](const CheckContext& c) { return monteCarlo(c, 1, 0.05, Term::kSpecular); }},
      {"area_mixture/four_lobes", measure,
       [](const CheckContext& c) { return monteCarlo(c, 4, 0.2, Term::kSpecular); }},
      {"area_mixture/grazing", measure,
       [](const CheckContext& c) { return monteCarlo(c, 1, 0.05, Term::kGrazing); }},
      {"area_mixture/schlick", measure,
       [](const CheckContext& c) { return monteCarlo(c, 4, 0.2, Term::kSchlick); }},
      {"area_mixture/diffuse", measure,
       [](const CheckContext& c) { return monteCarlo(c, 4, 0.2, Term::kDiffuse); }},
      {"area_mixture/is_the_lobe", "absolute error",
       [](const CheckContext& c) { return noVariance(c, 1); }},
      {"area_mixture/are_two_lobes", "absolute error",
       [](const CheckContext& c) { return noVariance(c, 2); }},
      {"area_mixture/turned_away", "most that is reflected", turnedAway}};
  for (const HardMixture& hard : hardMixtures())
    checks.push_back({fmt::format("hard_mixture/{}", hard.name), "most that is reflected",
                      [&hard](const CheckContext& context) { return hardMixture(context, hard); }});
  return checks;
}

}  // namespace glintmark
