// Polygon lights over a clamped cosine: against closed forms and the double-precision reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/reference/polygon_light.h"
#include "tests/glint/pixel_harness.h"
#include "tests/ltc/area_light_harness.h"

namespace glintmark {
namespace {

constexpr double kPi = std::numbers::pi;
// Single precision over a dozen terms of at most 1/2, and the edge fit's 1e-7.
constexpr double kFormFactorTolerance = 1e-5;
// Of tiny lights: directions are good to 6e-8, differences of directions of a light of 1e-10
// steradians, 1e-5 wide, to 6e-3.
constexpr double kTinyLightRelative = 0.03;

std::vector<glm::dvec3> rectangle(double cx, double cy, double cz, double width, double height) {
  return rectangleVertices({cx, cy, cz}, {0, 0, -1}, {0, 1, 0}, {width, height});
}

// The light's vertices seen from a point, z along its normal.
std::vector<glm::dvec3> inFrame(const AreaLight& light, const HandMadePoint& point) {
  const glm::dvec3 n = point.normal;
  const glm::dvec3 axis = std::abs(n.x) > 0.6 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 t = glm::normalize(axis - n * glm::dot(axis, n)), b = glm::cross(n, t);
  std::vector<glm::dvec3> local;
  for (const glm::dvec3& v : light.vertices) {
    const glm::dvec3 d = v - point.position;
    local.emplace_back(glm::dot(t, d), glm::dot(b, d), glm::dot(n, d));
  }
  return local;
}

double exactFormFactor(const AreaLight& light, const HandMadePoint& point) {
  // Counter-clockwise from the front is clockwise about the direction to the light.
  const double signed_factor = -reference::polygonFormFactor(inFrame(light, point));
  return light.two_sided ? std::abs(signed_factor) : std::max(signed_factor, 0.0);
}

// Points all around the origin, with normals of all directions: most horizons cut the light.
std::vector<HandMadePoint> randomPoints(int count, double distance, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<HandMadePoint> points;
  for (int i = 0; i < count; ++i) {
    HandMadePoint p;
    p.position = distance * glm::dvec3(normal(random), normal(random), normal(random));
    p.normal = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    // Values as the kernel gets them.
    p.position = glm::dvec3(glm::vec3(p.position));
    p.normal = glm::normalize(glm::dvec3(glm::vec3(p.normal)));
    p.view = p.normal;
    points.push_back(p);
  }
  return points;
}

AreaLight regularPolygon(int corners, bool two_sided) {
  std::vector<glm::dvec3> vertices;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * i / corners;
    vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return polygonLight(vertices, two_sided);
}

AreaLightProbe identityProbe(const AreaLight& light, bool specular) {
  AreaLightProbe probe;
  probe.material = specular ? whiteSpecular() : whiteDiffuse();
  probe.lights = {light};
  probe.table = identityTable();
  return probe;
}

class PolygonCorners : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(AllCounts, PolygonCorners, testing::Values(3, 4, 8));

TEST_P(PolygonCorners, IdentityIsTheExactFormFactor) {
  const AreaLight light = regularPolygon(GetParam(), true);
  const std::vector<HandMadePoint> points = randomPoints(2048, 1.5, 1);
  for (const bool specular : {false, true}) {
    const std::vector<glm::vec3> values = lightPoints(identityProbe(light, specular), points);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      worst = std::max(worst, std::abs(values[i].x - exactFormFactor(light, points[i])));
    EXPECT_LT(worst, kFormFactorTolerance) << (specular ? "specular" : "diffuse");
  }
}

TEST(Polygon, OneSidedLightsAreBlackFromBehind) {
  AreaLight light = regularPolygon(4, false);
  const std::vector<HandMadePoint> points = randomPoints(2048, 1.5, 2);
  const std::vector<glm::vec3> values = lightPoints(identityProbe(light, false), points);
  int lit = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(values[i].x, exactFormFactor(light, points[i]), kFormFactorTolerance);
    if (points[i].position.z < 0)
      EXPECT_EQ(values[i].x, 0) << "the front faces +z";
    else
      lit += values[i].x > 0;
  }
  EXPECT_GT(lit, 100);
}

TEST(Polygon, ParallelRectangleAboveItsCorner) {
  // A point below a corner of a parallel rectangle of sides a and b at distance 1: the textbook's
  // closed form (Howell, configuration B-3).
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, {0.1, 3.0}, {20.0, 0.5}, {100.0, 100.0}}) {
    const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
    const double exact = (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi);
    const AreaLight light = polygonLight(rectangle(a / 2, b / 2, 1, a, b));
    EXPECT_NEAR(lightPoints(identityProbe(light, false), {HandMadePoint{}})[0].x, exact,
                kFormFactorTolerance);
  }
}

TEST(Polygon, PerpendicularRectangleStandingOnTheSurface) {
  // A rectangle that stands on the receiver's plane at distance c, from its foot's corner: Howell's
  // configuration B-5. Its lower edge lies exactly on the horizon.
  for (const auto& [width, height, distance] :
       {std::tuple{1.0, 1.0, 1.0}, {2.0, 0.3, 0.1}, {0.5, 10.0, 3.0}}) {
    const double x = width / distance, y = height / distance, r = std::sqrt(1 + y * y);
    const double exact = (std::atan(x) - std::atan(x / r) / r) / (2 * kPi);
    const AreaLight light = polygonLight(
        {{0, distance, 0}, {0, distance, height}, {width, distance, height}, {width, distance, 0}},
        true);
    EXPECT_NEAR(lightPoints(identityProbe(light, false), {HandMadePoint{}})[0].x, exact,
                kFormFactorTolerance);
  }
}

TEST(Polygon, FullHemisphereReflectsEverything) {
  const AreaLight light = polygonLight(rectangle(0, 0, 1, 2e5, 2e5));
  for (const bool specular : {false, true})
    EXPECT_NEAR(lightPoints(identityProbe(light, specular), {HandMadePoint{}})[0].x, 1,
                kFormFactorTolerance);
}

TEST(Polygon, SolidAngleFromTinyToHemisphere) {
  for (double omega = 1e-10; omega < 6; omega *= 4) {
    const double side = std::sqrt(omega);
    HandMadePoint point;
    point.position = {0.3, -0.2, 0};
    const AreaLight light = polygonLight(rectangle(0.5, 0.4, 1, side, side));
    const double exact = exactFormFactor(light, point);
    const double value = lightPoints(identityProbe(light, false), {point})[0].x;
    EXPECT_NEAR(value / exact, 1, omega < 1e-6 ? kTinyLightRelative : 1e-3) << omega;
  }
}

TEST(Polygon, LanesAgreeBitForBit) {
  AreaLightProbe probe = identityProbe(regularPolygon(4, true), true);
  probe.lights.push_back(polygonLight(rectangle(1, 1, 0.5, 2, 1)));
  const std::vector<HandMadePoint> points = randomPoints(777, 1.5, 3);
  for (const bool clipless : {false, true}) {
    probe.clipless = clipless;
    probe.width = 16;
    const std::vector<glm::vec3> wide = lightPoints(probe, points);
    for (const int width : {1, 8}) {
      probe.width = width;
      EXPECT_EQ(lightPoints(probe, points), wide) << width;
    }
  }
}

TEST(Polygon, ClippedAndCliplessAgreeAwayFromTheHorizonOnly) {
  AreaLightProbe probe = identityProbe(polygonLight(rectangle(0, 0, 3, 0.4, 0.4)), false);
  const double above = lightPoints(probe, {HandMadePoint{}})[0].x;
  probe.clipless = true;
  EXPECT_NEAR(lightPoints(probe, {HandMadePoint{}})[0].x / above, 1, 0.01);
  // Half below and far from round: the form factor of a sphere is off by half and more.
  probe.lights = {polygonLight({{2, -1, -1}, {2, -1, 1}, {2, 1, 1}, {2, 1, -1}}, true)};
  const double bent = lightPoints(probe, {HandMadePoint{}})[0].x;
  const double exact = exactFormFactor(probe.lights[0], HandMadePoint{});
  EXPECT_NEAR(bent / exact, 1, 1);
  EXPECT_GT(std::abs(bent / exact - 1), 0.1);
}

}  // namespace
}  // namespace glintmark
