// Polygon integrals against closed forms from elsewhere and against Boost's quadrature.
#include <gtest/gtest.h>

#include "host/fit/ltc_lobe.h"
#include "host/reference/ltc.h"
#include "host/reference/polygon_light.h"
#include "tests/fit/hemisphere_integral.h"

namespace glintmark {
namespace {

using reference::Ndf;
using Polygon = std::vector<glm::dvec3>;

// Sums of a few terms of size one in double precision.
constexpr double kRounding = 1e-13;
// microfacetOverPolygon promises 1e-5; Boost is asked for less.
constexpr double kCubatureError = 2e-5;

// A square of half side `half` at `centre`, facing the receiver, right-handed about +z.
Polygon squareAbove(const glm::dvec3& centre, double half) {
  return {centre + glm::dvec3(-half, -half, 0), centre + glm::dvec3(half, -half, 0),
          centre + glm::dvec3(half, half, 0), centre + glm::dvec3(-half, half, 0)};
}

// A wall x = distance from z = low to z = high, half width `half`, right-handed about +x.
Polygon wall(double distance, double half, double low, double high) {
  return {{distance, -half, low},
          {distance, half, low},
          {distance, half, high},
          {distance, -half, high}};
}

// Point to a parallel rectangle of sides a and b with a corner at distance 1 straight above it:
// Howell's catalogue of configuration factors, B-3.
double cornerFactor(double a, double b) {
  const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * std::numbers::pi);
}

TEST(PolygonFormFactor, ParallelSquare) {
  for (const double half : {0.01, 0.5, 3.0, 40.0}) {
    EXPECT_NEAR(reference::polygonFormFactor(squareAbove({0, 0, 1}, half)),
                4 * cornerFactor(half, half), kRounding);
  }
}

TEST(PolygonFormFactor, PolygonWithManySidesIsADisc) {
  constexpr int kSides = 2000;
  Polygon disc;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    disc.push_back({0.7 * std::cos(angle), 0.7 * std::sin(angle), 1.3});
  }
  // r^2 / (r^2 + h^2); the polygon's area is short of the disc's by (pi / sides)^2 * 2 / 3.
  EXPECT_NEAR(reference::polygonFormFactor(disc), 0.49 / (0.49 + 1.69), 2e-6);
}

TEST(PolygonFormFactor, SkyIsOneAndHalfTheSkyAHalf) {
  EXPECT_NEAR(reference::polygonFormFactor(squareAbove({0, 0, 1e-7}, 1)), 1, 1e-6);
  EXPECT_NEAR(reference::polygonFormFactor(wall(1e-9, 1, -1, 1)), 0.5, 1e-6);
}

TEST(PolygonFormFactor, TurnedRoundIsNegative) {
  Polygon square = squareAbove({0.3, 0.2, 1}, 0.5);
  const double front = reference::polygonFormFactor(square);
  std::reverse(square.begin(), square.end());
  EXPECT_NEAR(reference::polygonFormFactor(square), -front, kRounding);
}

TEST(PolygonFormFactor, NothingFromBelowEdgeOnOrDegenerate) {
  EXPECT_EQ(reference::polygonFormFactor(squareAbove({0, 0, -1}, 2)), 0);
  EXPECT_NEAR(reference::polygonFormFactor({{{0, 0, 1}, {0, 0, 2}, {1, 0, 2}, {1, 0, 1}}}), 0,
              kRounding);
  EXPECT_NEAR(reference::polygonFormFactor({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}), 0, kRounding);
}

TEST(PolygonFormFactor, ClippedAtTheHorizon) {
  // A wall that crosses the horizon shows what the wall above it shows.
  EXPECT_NEAR(reference::polygonFormFactor(wall(2, 1.5, -3, 4)),
              reference::polygonFormFactor(wall(2, 1.5, 0, 4)), kRounding);
}

TEST(PolygonFormFactor, TinyLightIsItsSolidAngleTimesCosine) {
  const glm::dvec3 centre(0.6, 0, 0.8);
  const Polygon square = squareAbove(1e5 * centre, 0.5);
  const double solid_angle = reference::polygonSolidAngle(square);
  EXPECT_NEAR(solid_angle, 0.8e-10, 1e-15);
  EXPECT_NEAR(reference::polygonFormFactor(square), solid_angle * 0.8 / std::numbers::pi, 1e-15);
}

TEST(PolygonSolidAngle, CubeFaceIsASixthOfTheSphere) {
  EXPECT_NEAR(reference::polygonSolidAngle(squareAbove({0, 0, 1}, 1)), 4 * std::numbers::pi / 6,
              kRounding);
}

TEST(LtcOverPolygon, IdentityIsTheFormFactor) {
  for (const Polygon& light :
       {squareAbove({0.3, -0.5, 1}, 0.8), wall(0.5, 2, -1, 0.7), wall(3, 0.1, 0.01, 0.02)}) {
    EXPECT_NEAR(reference::ltcOverPolygon(glm::dmat3(1.0), light),
                reference::polygonFormFactor(light), kRounding);
  }
}

glm::dmat3 slantedLobe() {
  return ltcInverseMatrix(LtcLobe{std::log(0.4), std::log(0.25), 0.2, -0.9});
}

TEST(LtcDensity, IntegratesToOneOverTheSphereAndToItsMassAboveTheHorizon) {
  const glm::dmat3 inverse = slantedLobe();
  const auto density = [&](const glm::dvec3& d) { return reference::ltcDensity(inverse, d); };
  const double above = integrateDirections(density, 0, 1),
               below = integrateDirections(density, -1, 0);
  EXPECT_NEAR(above + below, 1, 1e-5);
  EXPECT_NEAR(reference::ltcMassAboveHorizon(inverse), above, 1e-5);
  EXPECT_GT(below, 0.01) << "the lobe must cross the horizon for this test to say anything";
}

TEST(LtcDensity, DoesNotDependOnScales) {
  const glm::dvec3 d = glm::normalize(glm::dvec3(-0.7, 0.2, 0.6));
  const double density = reference::ltcDensity(slantedLobe(), d);
  EXPECT_NEAR(reference::ltcDensity(7.0 * slantedLobe(), d), density, 1e-12 * density);
  EXPECT_NEAR(reference::ltcDensity(slantedLobe(), 5.0 * d), density, 1e-12 * density);
}

TEST(LtcOverPolygon, SkyIsTheMassAboveTheHorizon) {
  EXPECT_NEAR(reference::ltcOverPolygon(slantedLobe(), squareAbove({0, 0, 1e-8}, 1)),
              reference::ltcMassAboveHorizon(slantedLobe()), 1e-6);
}

// Integral over a wall x = distance of a density per solid angle, by Boost.
template <typename Density>
double overWall(const Density& density, double distance, double half, double low, double high) {
  const auto row = [&](double z) {
    const auto at = [&](double y) {
      const double length = std::sqrt(distance * distance + y * y + z * z);
      return density(glm::dvec3(distance, y, z) / length) * std::abs(distance) /
             (length * length * length);
    };
    return Quadrature::integrate(at, -half, half, kQuadratureDepth, 1e-8);
  };
  return Quadrature::integrate(row, low, high, kQuadratureDepth, 1e-8);
}

TEST(LtcOverPolygon, AgreesWithQuadrature) {
  const auto density = [](const glm::dvec3& d) { return reference::ltcDensity(slantedLobe(), d); };
  const double expected = overWall(density, -1, 0.8, 0, 1.5);
  Polygon light = wall(-1, 0.8, -0.5, 1.5);
  std::reverse(light.begin(), light.end());
  EXPECT_NEAR(reference::ltcOverPolygon(slantedLobe(), light), expected, 1e-6);
}

TEST(MicrofacetOverPolygon, AgreesWithQuadrature) {
  const double theta = 0.8;
  const glm::dvec3 view(std::sin(theta), 0, std::cos(theta));
  for (const Ndf ndf : {Ndf::kGgx, Ndf::kBeckmann}) {
    for (const double alpha : {0.15, 0.6}) {
      const auto brdf = [&](const glm::dvec3& d) {
        return reference::microfacetTimesCosine(ndf, d, view, alpha);
      };
      const double expected = overWall(brdf, -1, 0.8, 0, 1.5);
      Polygon light = wall(-1, 0.8, -0.5, 1.5);
      std::reverse(light.begin(), light.end());
      const glm::dmat3 flatten = ltcInverseMatrix(mirrorLobe(alpha, view.z));
      EXPECT_NEAR(reference::microfacetOverPolygon(ndf, view, alpha, 1, flatten, light), expected,
                  kCubatureError)
          << reference::ndfName(ndf) << " " << alpha;
    }
  }
}

TEST(MicrofacetOverPolygon, DoesNotDependOnWhatItIsFlattenedBy) {
  const glm::dvec3 view(std::sin(1.2), 0, std::cos(1.2));
  const Polygon light = {{-3, -1, 0.1}, {-3, -1, 2}, {-3, 1, 2}, {-3, 1, 0.1}};
  const double alpha = 0.02;
  const double narrow = reference::microfacetOverPolygon(
      Ndf::kGgx, view, alpha, 0.04, ltcInverseMatrix(mirrorLobe(alpha, view.z)), light);
  const double narrower = reference::microfacetOverPolygon(
      Ndf::kGgx, view, alpha, 0.04, ltcInverseMatrix(mirrorLobe(alpha / 2, view.z)), light);
  EXPECT_GT(narrow, 0.05);
  EXPECT_NEAR(narrow, narrower, kCubatureError);
}

}  // namespace
}  // namespace glintmark
