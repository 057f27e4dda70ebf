#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/core/angles.h"
#include "host/core/error.h"
#include "host/scene/environment.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

// Cones are stored as floats; the sums over half a million pixels are doubles.
constexpr double kFluxTolerance = 1e-4;
// A pixel of the 64 x 32 map is 5.6 degrees wide, so a lone one is known to half of that.
constexpr double kPixelAngle_rad = 2 * kPi / 64;

Image constantMap(int width, int height, float value) {
  Image map(width, height, 3);
  std::fill(map.pixels.begin(), map.pixels.end(), value);
  return map;
}

glm::dvec3 totalFlux(const std::vector<ConeLight>& cones) {
  glm::dvec3 sum(0);
  for (const ConeLight& cone : cones) sum += coneFlux(cone);
  return sum;
}

glm::dvec3 axisOf(const ConeLight& cone) {
  return {cone.direction.x, cone.direction.y, cone.direction.z};
}

void expectSound(const std::vector<ConeLight>& cones) {
  for (const ConeLight& cone : cones) {
    EXPECT_NEAR(glm::length(axisOf(cone)), 1, 1e-6);
    EXPECT_GE(cone.direction.w, 0);
    EXPECT_LE(cone.direction.w, kPi / 2 + 1e-6);
    EXPECT_GE(cone.irradiance.x, 0);
  }
}

// What is seen towards a lone pixel is that pixel, and its cone stands there, however it is turned.
TEST(Environment, IsSeenWhereItsConesStand) {
  Image map = constantMap(64, 32, 0);
  map.at(20, 9)[1] = 7;
  for (const double turn : {0.0, 1.0, -2.5}) {
    const EnvironmentCut cut{1, 0.5, turn};
    const glm::dvec3 axis = axisOf(cutEnvironment(map, cut).front());
    EXPECT_NEAR(environmentRadiance(map, cut, 3.0 * axis).y, 3.5, 0.05);
    EXPECT_EQ(environmentRadiance(map, cut, -axis).y, 0);
  }
}

// Linear between pixels, across the seam and up to the poles.
TEST(Environment, IsSeenWithoutAJump) {
  Image map = constantMap(16, 8, 1);
  for (int y = 0; y < 8; ++y) map.at(0, y)[0] = 3;
  const auto seen = [&](double azimuth) {
    return environmentRadiance(map, {}, {std::sin(azimuth), 0.1, std::cos(azimuth)}).x;
  };
  EXPECT_NEAR(seen(0), 2, 1e-9);  // the border between the first column and the last
  EXPECT_NEAR(seen(-kPi / 16), 3, 1e-9);
  EXPECT_NEAR(seen(kPi / 16), 1, 1e-9);
  EXPECT_NEAR(environmentRadiance(map, {}, {0, 1, 0}).y, 1, 1e-9);
  EXPECT_NEAR(environmentRadiance(constantMap(1, 1, 2), {}, {0, -1, 0}).z, 2, 1e-9);
}

class ConeCounts : public testing::TestWithParam<int> {};

// A sphere of radiance 1 has flux 4 pi, however it is cut.
TEST_P(ConeCounts, KeepTheFluxOfAnEvenSky) {
  const std::vector<ConeLight> cones = cutEnvironment(constantMap(64, 32, 1), {GetParam(), 1, 0});
  EXPECT_EQ(static_cast<int>(cones.size()), GetParam());
  expectSound(cones);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(totalFlux(cones)[c] / (4 * kPi), 1, kFluxTolerance);
  }
}

// Radiance 1 + cos(angle from +y) has flux 4 pi and vector flux 4 pi / 3 towards +y.
TEST_P(ConeCounts, KeepTheFluxOfAGradient) {
  Image map(128, 64, 3);
  for (int y = 0; y < map.height; ++y) {
    const double top = kPi * y / map.height, bottom = kPi * (y + 1) / map.height;
    // Mean over the row, so that the map holds exactly this sky.
    const double mean_cos =
        0.25 * (std::cos(2 * top) - std::cos(2 * bottom)) / (std::cos(top) - std::cos(bottom));
    for (int x = 0; x < map.width; ++x) {
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = static_cast<float>((1 + mean_cos) * (c + 1));
    }
  }
  const std::vector<ConeLight> cones = cutEnvironment(map, {GetParam(), 0.5, 0});
  expectSound(cones);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(totalFlux(cones)[c] / (0.5 * 4 * kPi * (c + 1)), 1, kFluxTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ConeCounts, testing::Values(1, 2, 3, 8, 31, 64));

TEST(Environment, ALampBecomesANarrowConeInItsDirection) {
  Image map = constantMap(64, 32, 0.01f);
  // Row 8 of 32 is about 45 degrees up; column 48 of 64 looks along +x.
  for (int c = 0; c < 3; ++c) map.at(48, 8)[c] = 1000;
  const std::vector<ConeLight> cones = cutEnvironment(map, {8, 1, 0});
  const auto brightest = std::max_element(
      cones.begin(), cones.end(),
      [](const ConeLight& a, const ConeLight& b) { return a.irradiance.x < b.irradiance.x; });
  const double elevation = kPi / 2 - kPi * 8.5 / 32;
  EXPECT_NEAR(axisOf(*brightest).y, std::sin(elevation), kPixelAngle_rad);
  EXPECT_NEAR(axisOf(*brightest).x, std::cos(elevation), kPixelAngle_rad);
  EXPECT_LT(brightest->direction.w, kPixelAngle_rad);
  // Turned a quarter from +z towards +x, what was at +x is at -z.
  const ConeLight turned = cutEnvironment(map, {1, 1, kPi / 2})[0];
  EXPECT_NEAR(axisOf(turned).z, -std::cos(elevation), 0.1);
}

TEST(Environment, AnEvenCapGetsItsOwnAngle) {
  // All light within 40 degrees of +y.
  constexpr double kCapAngle_rad = 40 * kPi / 180;
  Image map = constantMap(360, 180, 0);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < map.width; ++x) {
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = 2;
    }
  }
  const std::vector<ConeLight> cones = cutEnvironment(map, {1, 1, 0});
  ASSERT_EQ(cones.size(), 1u);
  EXPECT_NEAR(cones[0].direction.y, 1, 1e-6);
  // Rows of one degree: their middles stand for the whole row, which is 5e-5 off in the cosine.
  EXPECT_NEAR(cones[0].direction.w, kCapAngle_rad, 2e-4);
  // Irradiance of a surface under an even cap of radiance L: pi L sin^2.
  EXPECT_NEAR(cones[0].irradiance.x, kPi * 2 * std::pow(std::sin(kCapAngle_rad), 2), 1e-3);
}

TEST(Environment, CutsAreDeterministicAndStopAtPixels) {
  const Image map = renderSky({});
  const std::vector<ConeLight> a = cutEnvironment(map, {16, 1, 0}),
                               b = cutEnvironment(map, {16, 1, 0});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].direction.x, b[i].direction.x);
    EXPECT_EQ(a[i].irradiance.z, b[i].irradiance.z);
  }
  Image stars = constantMap(64, 32, 0);
  for (const int x : {3, 30}) stars.at(x, 9)[1] = 7;
  EXPECT_EQ(cutEnvironment(stars, {100, 1, 0}).size(), 2u);
  EXPECT_EQ(cutEnvironment(constantMap(1, 1, 1), {100, 1, 0}).size(), 100u);
}

// An even sky is even however few pixels, rows or columns say so.
TEST(Environment, PixelsOfCoarseMapsAreAreas) {
  const std::vector<ConeLight> wanted = cutEnvironment(constantMap(512, 256, 1), {256, 1, 0});
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 64}, {512, 1}, {8, 4}}) {
    const std::vector<ConeLight> cones = cutEnvironment(constantMap(width, height, 1), {256, 1, 0});
    // What a floor gets of cones so narrow that the horizon cuts little of them.
    const auto on_floor = [](const std::vector<ConeLight>& lights) {
      double sum = 0;
      for (const ConeLight& c : lights)
        sum += static_cast<double>(c.irradiance.x) * std::max(0.0f, c.direction.y);
      return sum;
    };
    EXPECT_NEAR(totalFlux(cones).x, 4 * kPi, 1e-3) << width << " x " << height;
    EXPECT_NEAR(on_floor(cones), on_floor(wanted), 0.05 * on_floor(wanted))
        << width << " x " << height;
  }
}

TEST(Environment, MoreConesLessSpread) {
  const Image map = renderSky({});
  double last = 10;
  for (const int count : {1, 4, 16, 64}) {
    double widest = 0;
    for (const ConeLight& cone : cutEnvironment(map, {count, 1, 0})) {
      widest = std::max(widest, static_cast<double>(cone.direction.w));
    }
    EXPECT_LE(widest, last);
    last = widest;
  }
  EXPECT_LT(last, 0.5);
}

TEST(Environment, BadMaps) {
  Image map = constantMap(4, 2, 1);
  map.at(3, 1)[1] = -1;
  expectMessage(errorOf([&] { cutEnvironment(map, {}); }), {"pixel (3, 1)", "-1"});
  map.at(3, 1)[1] = std::nanf("");
  expectMessage(errorOf([&] { cutEnvironment(map, {}); }), {"pixel (3, 1)", "nan"});
  expectMessage(errorOf([&] { cutEnvironment(constantMap(4, 2, 0), {}); }), {"black"});
  expectMessage(errorOf([&] { cutEnvironment(Image(), {}); }), {"0 x 0"});
  expectMessage(errorOf([&] { cutEnvironment(Image(2, 2, 1), {}); }), {"1 channels"});
}

TEST(Environment, LampsOfTheSkyAreInTheMap) {
  SkyParameters sky;
  sky.zenith = sky.horizon = sky.ground = glm::dvec3(0);
  sky.lamps.push_back({glm::normalize(glm::dvec3(1, 1, 0)), 0.2, glm::dvec3(10)});
  const std::vector<ConeLight> cones = cutEnvironment(renderSky(sky), {1, 1, 0});
  ASSERT_EQ(cones.size(), 1u);
  EXPECT_NEAR(axisOf(cones[0]).x, std::sqrt(0.5), 1e-2);
  EXPECT_NEAR(cones[0].direction.w, 0.2, 1e-2);
}

TEST(Environment, TinyNegativesCountAsNothing) {
  Image map(4, 2, 3);
  std::fill(map.pixels.begin(), map.pixels.end(), 1.0f);
  Image clean = map;
  EXPECT_EQ(clampTinyNegatives(clean), "");
  map.at(3, 1)[1] = -4e-7f;
  map.at(0, 0)[0] = -2e-3f;
  const std::string note = clampTinyNegatives(map);
  expectMessage(note, {"2 values", "-0.002"});
  EXPECT_EQ(map.at(3, 1)[1], 0.0f);
  EXPECT_FALSE(cutEnvironment(map, {}).empty());
  map.at(2, 1)[1] = -0.5f;  // no ringing
  EXPECT_EQ(clampTinyNegatives(map), "");
  expectMessage(errorOf([&] { cutEnvironment(map, {}); }), {"pixel (2, 1)", "-0.5"});
  map.at(2, 1)[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(clampTinyNegatives(map), "");
  expectMessage(errorOf([&] { cutEnvironment(map, {}); }), {"pixel (2, 1)", "inf"});
}

}  // namespace
}  // namespace glintmark
