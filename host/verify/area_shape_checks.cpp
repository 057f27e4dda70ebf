// Discs, spheres and tubes as area lights, of a diffuse surface and of transformed cosines: against
// facets, and against rays, in double precision.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/fit/ltc_lobe.h"
#include "host/harness/specular_cases.h"
#include "host/harness/tolerances.h"
#include "host/reference/ltc.h"
#include "host/reference/round_light.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

using reference::RoundLight;

constexpr int kSides = 1024, kRaysAcross = 500;

AreaLight discLight(const glm::dvec3& centre, const glm::dvec3& normal, double radius) {
  AreaLight light;
  light.shape = LightShape::kDisc;
  light.centre = centre;
  light.axis = glm::normalize(normal);
  light.radius = radius;
  light.two_sided = true;
  return light;
}

AreaLight sphereLight(const glm::dvec3& centre, double radius, bool two_sided = false) {
  AreaLight light;
  light.shape = LightShape::kSphere;
  light.centre = centre;
  light.radius = radius;
  light.two_sided = two_sided;
  return light;
}

AreaLight tubeLight(const glm::dvec3& from, const glm::dvec3& to, double radius,
                    bool two_sided = false) {
  AreaLight light;
  light.shape = LightShape::kTube;
  light.centre = from;
  light.axis = to - from;
  light.radius = radius;
  light.two_sided = two_sided;
  return light;
}

// The light in a point's frame, the view in its plane of x and z.
RoundLight inFrameOf(const AreaLight& light, const HandMadePoint& point) {
  const glm::dvec3 n = point.normal;
  glm::dvec3 x = point.view - glm::dot(point.view, n) * n;
  if (glm::length(x) < 1e-6)
    x = glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  x = glm::normalize(x);
  const glm::dvec3 y = glm::cross(n, x);
  const auto local = [&](const glm::dvec3& d) {
    return glm::dvec3(glm::dot(x, d), glm::dot(y, d), glm::dot(n, d));
  };
  RoundLight seen;
  seen.shape = light.shape == LightShape::kDisc     ? RoundLight::Shape::kDisc
               : light.shape == LightShape::kSphere ? RoundLight::Shape::kSphere
                                                    : RoundLight::Shape::kTube;
  seen.centre = local(light.centre - point.position);
  seen.axis = local(light.axis);
  seen.radius = light.radius;
  return seen;
}

// A lobe's share of a light, by one way or the other.
using Share = double (*)(const glm::dmat3& inverse, const RoundLight& light, int count);

// What a white diffuse, or a white mirroring surface reflects.
double wanted(const AreaLight& light, const HandMadePoint& point, bool specular, Share share,
              int count) {
  const RoundLight seen = inFrameOf(light, point);
  if (!specular) return share(glm::dmat3(1), seen, count);
  const double cosine = std::max(glm::dot(point.view, point.normal), 0.0);
  const LtcCell cell = lookUpLtc(shippedGgx(), point.alpha, cosine);
  const double received = share(ltcInverseMatrix(cell, point.alpha, cosine), seen, count);
  return std::min(cell.scale * received, cell.albedo);
}

std::vector<glm::vec3> reflected(const CheckContext& context, const AreaLight& light,
                                 const std::vector<HandMadePoint>& points, bool specular,
                                 int lanes) {
  AreaLightProbe probe;
  probe.material = specular ? whiteSpecular() : whiteDiffuse();
  probe.lights = {light};
  probe.table = shippedGgx();
  probe.width = lanes;
  return lightPoints(context.bench, probe, points);
}

// --- Everywhere ----------------------------------------------------------------------------------

// A light of some size about the origin; its points lie outside of it.
AreaLight randomLight(LightShape shape, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto vector = [&] {
    return glm::dvec3(glm::vec3(normal(random), normal(random), normal(random)));
  };
  const double radius = static_cast<float>(std::exp(3 * uniform(random) - 3));
  if (shape == LightShape::kDisc) return discLight({0, 0, 0}, vector(), radius);
  if (shape == LightShape::kSphere) return sphereLight({0, 0, 0}, radius);
  const glm::dvec3 half = vector();
  return tubeLight(-half, half, radius);
}

bool isWithin(const AreaLight& light, const glm::dvec3& p) {
  if (light.shape == LightShape::kDisc) return false;
  if (light.shape == LightShape::kSphere) return glm::length(p) <= 1.01 * light.radius;
  const glm::dvec3 axis = glm::normalize(light.axis);
  const double along = glm::dot(p - light.centre, axis);
  return along > -0.01 && along < glm::length(light.axis) + 0.01 &&
         glm::length(p - light.centre - along * axis) < 1.01 * light.radius;
}

std::vector<HandMadePoint> pointsAround(const AreaLight& light, std::size_t count,
                                        std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto vector = [&] {
    return glm::dvec3(glm::vec3(normal(random), normal(random), normal(random)));
  };
  std::vector<HandMadePoint> points;
  while (points.size() < count) {
    HandMadePoint p;
    p.position = 1.2 * vector();
    p.position = glm::dvec3(glm::vec3(p.position));
    p.normal = glm::normalize(glm::dvec3(glm::vec3(glm::normalize(vector()))));
    p.view = glm::normalize(glm::dvec3(glm::vec3(glm::normalize(vector()))));
    p.alpha = static_cast<float>(0.01 + 0.99 * std::pow(uniform(random), 2));
    if (glm::dot(p.view, p.normal) < 0.03 || isWithin(light, p.position)) continue;
    points.push_back(p);
  }
  return points;
}

Finding anywhere(const CheckContext& context, LightShape shape, Share share, int count,
                 std::size_t lights, std::size_t points_each, double bound) {
  std::mt19937 random(static_cast<unsigned>(shape) + 11);
  Finding finding(bound);
  double most = 0;
  for (std::size_t l = 0; l < lights; ++l) {
    const AreaLight light = randomLight(shape, random);
    const std::vector<HandMadePoint> points = pointsAround(light, points_each, random);
    for (const bool specular : {false, true}) {
      const auto values = reflected(context, light, points, specular, context.lanes);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double want = wanted(light, points[i], specular, share, count);
        finding.add(std::abs(values[i].x - want));
        most = std::max(most, want);
      }
    }
  }
  finding.require(most > 0.1, "hardly any light");
  return finding;
}

Finding sameShapePoints(const CheckContext& context) {
  Finding finding(0);
  std::mt19937 random(5);
  for (const LightShape shape : {LightShape::kDisc, LightShape::kSphere, LightShape::kTube}) {
    const AreaLight light = randomLight(shape, random);
    const std::vector<HandMadePoint> points = pointsAround(light, 333, random);
    for (const bool specular : {false, true}) {
      const auto one = reflected(context, light, points, specular, 1),
                 wide = reflected(context, light, points, specular, context.lanes);
      double different = 0;
      for (std::size_t i = 0; i < one.size(); ++i) different += one[i] != wide[i];
      finding.add(different);
    }
  }
  return finding;
}

// --- Hard cases ----------------------------------------------------------------------------------

constexpr double kEverything = -1;  // the point is within: a lobe gets all of itself

struct HardShape {
  const char* name;
  AreaLight light;
  double fixed = 0;  // kEverything, or what is reflected whatever the lobe where `by_hand`
  bool by_hand = false;
};

// About a point at the origin whose normal is z.
const std::vector<HardShape>& hardShapes() {
  static const std::vector<HardShape> shapes = [] {
    AreaLight back = discLight({0, 0, 1}, {0, 0, 1}, 1);
    back.two_sided = false;
    return std::vector<HardShape>{
        {"disc_overhead", discLight({0, 0, 1}, {0, 0, -1}, 1)},
        {"disc_aslant", discLight({0.7, -0.4, 0.5}, {0.3, 0.5, -1}, 0.4)},
        {"disc_crosses_horizon", discLight({1, 0.3, 0}, {-1, 0.2, 0}, 0.8)},
        {"disc_below", discLight({1, 0, -1}, {0, 0, 1}, 0.9), 0, true},
        {"disc_edge_on", discLight({1, 0, 0.5}, {0, 1, 0}, 0.3), 0, true},
        {"disc_in_the_surface", discLight({2, 0, 0}, {0, 0, 1}, 1), 0, true},
        {"disc_a_hair_above", discLight({0.2, 0.1, 1e-4}, {0, 0, -1}, 1)},
        {"disc_grazing", discLight({3, 0, 0.01}, {0, 0, -1}, 1)},
        {"disc_tiny", discLight({0.5, 0.2, 0.7}, {0, 0.3, -1}, 1e-5)},
        {"disc_huge", discLight({0, 0, 1}, {0, 0, -1}, 1e6)},
        {"disc_back", back, 0, true},
        {"sphere_overhead", sphereLight({0.1, 0.2, 2}, 1)},
        {"sphere_crosses_horizon", sphereLight({1, 1, 0.1}, 0.7)},
        {"sphere_below", sphereLight({1, 0, -2}, 1), 0, true},
        {"sphere_touches", sphereLight({0, 0, 1.0001}, 1)},
        {"sphere_touches_aslant", sphereLight({0.8, 0, 0.6001}, 1)},
        {"sphere_inside_dark", sphereLight({0.1, 0, 0.2}, 1), 0, true},
        {"sphere_inside", sphereLight({0.1, 0, 0.2}, 1, true), kEverything},
        {"sphere_tiny", sphereLight({1, 0.5, 1}, 1e-6)},
        {"sphere_huge", sphereLight({0, 3e5, 1e6}, 1e6)},
        {"sphere_far", sphereLight({3e6, 1e6, 2e6}, 1e5)},
        {"tube_across", tubeLight({-1, 1, 1}, {1, 1, 1}, 0.1)},
        {"tube_crosses_horizon", tubeLight({0.5, 1, -1}, {0.7, 0.8, 1}, 0.2)},
        {"tube_half_sunk", tubeLight({-1, 1, 0}, {1, 1, 0}, 0.2)},
        {"tube_stands_on_horizon", tubeLight({1, 1, 0}, {1, 1, 2}, 0.3)},
        {"tube_lies_on_horizon", tubeLight({-1, 1, 0.25}, {1, 1, 0.25}, 0.25)},
        {"tube_below", tubeLight({-1, 1, -1}, {1, 1, -1}, 0.5), 0, true},
        {"tube_end_on", tubeLight({0.3, 0.3, 1}, {0.9, 0.9, 3}, 0.2)},
        {"tube_on_its_line", tubeLight({0, 0, 0.5}, {0, 0, 2}, 0.25)},
        {"tube_beside_its_line", tubeLight({0.2499, 0, 0.5}, {0.2499, 0, 2}, 0.25)},
        {"tube_at_its_rim", tubeLight({0.2501, 0, 0.5}, {0.2501, 0, 2}, 0.25)},
        {"tube_thin", tubeLight({-1, 0.5, 1}, {1, 0.5, 1}, 1e-4)},
        {"tube_thick", tubeLight({-0.1, 2, 1}, {0.1, 2, 1}, 1.5)},
        {"tube_long", tubeLight({-1e3, 0.5, 1}, {1e3, 0.5, 1}, 0.3)},
        {"tube_huge", tubeLight({-1e5, 0, 1.2e6}, {1e5, 0, 1.2e6}, 1e6)},
        {"tube_inside_dark", tubeLight({-1, 0, 0.1}, {1, 0, 0.1}, 0.5), 0, true},
        {"tube_inside", tubeLight({-1, 0, 0.1}, {1, 0, 0.1}, 0.5, true), kEverything}};
  }();
  return shapes;
}

std::vector<HandMadePoint> viewsOfHardShapes() {
  std::vector<HandMadePoint> points;
  for (const double alpha : {0.02, 0.1, 0.4, 1.0})
    for (const double angle_deg : {90.0, 45.0, 10.0, 2.0})
      for (const double azimuth : {0.0, 1.0, 4.0}) {
        HandMadePoint p;
        const double angle = angle_deg * kDegree;
        p.view = {std::cos(angle) * std::cos(azimuth), std::cos(angle) * std::sin(azimuth),
                  std::sin(angle)};
        p.view = glm::normalize(glm::dvec3(glm::vec3(p.view)));
        p.alpha = static_cast<float>(alpha);
        points.push_back(p);
      }
  return points;
}

double wantedHard(const HardShape& shape, const HandMadePoint& point, bool specular) {
  if (shape.by_hand) return shape.fixed;
  if (shape.fixed != kEverything)
    return wanted(shape.light, point, specular, reference::ltcOverRoundLight, kSides);
  if (!specular) return 1;
  const LtcCell cell = lookUpLtc(shippedGgx(), point.alpha, point.view.z);
  const glm::dmat3 inverse = ltcInverseMatrix(cell, point.alpha, point.view.z);
  return std::min(cell.scale * reference::ltcMassAboveHorizon(inverse), cell.albedo);
}

// Diffuse and specular, from straight down to 2 degrees.
Finding hardShape(const CheckContext& context, const HardShape& shape) {
  const std::vector<HandMadePoint> points = viewsOfHardShapes();
  Finding finding(kRoundLight);
  for (const bool specular : {false, true}) {
    const auto values = reflected(context, shape.light, points, specular, context.lanes);
    for (std::size_t i = 0; i < points.size(); ++i) {
      finding.add(std::abs(values[i].x - wantedHard(shape, points[i], specular)));
      finding.require(std::isfinite(values[i].x) && values[i].x >= 0,
                      fmt::format("radiance {}", values[i].x));
    }
  }
  return finding;
}

struct NamedShape {
  const char* name;
  LightShape shape;
};
constexpr NamedShape kRoundShapes[] = {
    {"disc", LightShape::kDisc}, {"sphere", LightShape::kSphere}, {"tube", LightShape::kTube}};

}  // namespace

std::vector<Check> areaShapeChecks() {
  std::vector<Check> checks;
  for (const NamedShape& named : kRoundShapes) {
    checks.push_back({fmt::format("area_shape/{}_anywhere", named.name), "absolute error",
                      [&named](const CheckContext& c) {
                        return anywhere(c, named.shape, reference::ltcOverRoundLight, kSides, 6, 96,
                                        kRoundLight);
                      }});
    checks.push_back({fmt::format("area_shape/{}_by_rays", named.name), "absolute error",
                      [&named](const CheckContext& c) {
                        return anywhere(c, named.shape, reference::ltcByRays, kRaysAcross, 4, 10,
                                        kRoundLightByRays);
                      }});
  }
  for (const HardShape& shape : hardShapes())
    checks.push_back({fmt::format("area_shape/{}", shape.name), "absolute error",
                      [&shape](const CheckContext& c) { return hardShape(c, shape); }});
  checks.push_back({"area_shape/same_bits", "points that differ from one lane's", sameShapePoints});
  return checks;
}

}  // namespace glintmark
