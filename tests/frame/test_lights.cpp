// Cone lights as the kernels get them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "host/core/angles.h"
#include "host/frame/effect/light_taps.h"
#include "host/frame/effect/light_tree.h"
#include "host/frame/effect/lights.h"

namespace glintmark {
namespace {

ConeLight cone(double half_deg) {
  ConeLight light{};
  light.direction = {0.6f, 0, 1.6f, static_cast<float>(half_deg * kDegree)};  // not unit
  light.irradiance = {1, 2, 3, 0};
  return light;
}

glm::dvec3 toDouble(const float4& v) {
  return {v.x, v.y, v.z};
}

TEST(Lights, PowerGivesTheIrradianceBack) {
  for (const double half_deg : {0.0, 0.25, 5.0, 45.0, 90.0}) {
    const ConeLight light = cone(half_deg);
    const LightParams prepared = prepareLights({&light, 1})[0];
    // Irradiance on a facing surface is radiance x solid angle x the mean cosine, (1 + cos) / 2.
    const double mean_cosine = 0.5 * (1 + std::cos(half_deg * kDegree));
    EXPECT_NEAR(prepared.power.x * mean_cosine, 1, 1e-6) << half_deg;
    EXPECT_NEAR(prepared.power.z * mean_cosine, 3, 1e-5) << half_deg;
  }
}

TEST(LightTaps, LieInTheConeAndAverageToItsAxis) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.6, 0, 1.6));
  for (const double half_deg : {0.0, 0.25, 5.0, 12.0, 15.0, 30.0, 45.0, 90.0}) {
    const ConeLight light = cone(half_deg);
    const PreparedTaps prepared = prepareTaps({&light, 1});
    ASSERT_EQ(prepared.directions.size(), prepared.lights[0].count);
    const double cosine = std::cos(half_deg * kDegree);
    glm::dvec3 mean(0.0);
    for (const float4& tap : prepared.directions) {
      const glm::dvec3 d = toDouble(tap);
      EXPECT_NEAR(glm::length(d), 1, 1e-6);
      EXPECT_GE(glm::dot(d, axis), cosine - 1e-6);
      mean += d / static_cast<double>(prepared.directions.size());
    }
    // The cone's own mean direction, to a tenth of its radius.
    const glm::dvec3 want = axis * (prepared.directions.size() == 1 ? 1.0 : 0.5 * (1 + cosine));
    EXPECT_LT(glm::length(mean - want), 0.1 * std::sin(half_deg * kDegree) + 1e-6)
        << half_deg << " degrees, " << prepared.directions.size() << " taps";
  }
}

TEST(Lights, TheConeIsItsHalfAngle) {
  for (const double half_deg : {0.01, 1.0, 20.0, 60.0, 90.0}) {
    const ConeLight light = cone(half_deg);
    const LightParams params = prepareLights({&light, 1})[0];
    const double angle = light.direction.w;
    EXPECT_NEAR(params.one_minus_cos / (2 * std::pow(std::sin(angle / 2), 2)), 1, 1e-6);
    EXPECT_NEAR(params.cotangent * std::tan(angle), 1, half_deg == 90 ? 1 : 1e-6);
  }
  const ConeLight point = cone(0);
  EXPECT_EQ(prepareLights({&point, 1})[0].one_minus_cos, 0);
}

TEST(LightTaps, OfSeveralLightsStandOneAfterAnother) {
  const std::vector<ConeLight> lights = {cone(0), cone(40), cone(1)};
  const PreparedTaps prepared = prepareTaps(lights);
  ASSERT_EQ(prepared.lights.size(), 3u);
  uint next = 0;
  for (const LightTaps& light : prepared.lights) {
    EXPECT_EQ(light.first, next);
    next += light.count;
  }
  EXPECT_EQ(next, prepared.directions.size());
}

TEST(Lights, OfNoneNothingIsMade) {
  EXPECT_TRUE(prepareLights({}).empty());
  EXPECT_TRUE(prepareTaps({}).directions.empty());
}

// Cones of 5 degrees around a circle, each of another power, and a point.
std::vector<ConeLight> ring(int count) {
  std::vector<ConeLight> lights;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * kPi * i / count;
    ConeLight light{};
    light.direction = {static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)), 0.5f,
                       static_cast<float>(5 * kDegree)};
    light.irradiance = {1.0f + 0.01f * static_cast<float>(i), 1, 1, 0};
    lights.push_back(light);
  }
  lights.push_back(cone(0));
  return lights;
}

TEST(LightTree, EachConeStandsForItsParts) {
  const std::vector<ConeLight> lights = ring(21);
  const LightTree tree = lightTree(lights);
  const std::vector<LightParams> params = prepareLightTree(lights);
  ASSERT_EQ(tree.lights.size(), 2 * 21 - 1 + 1u);  // a binary tree, and the point
  ASSERT_EQ(params.size(), tree.lights.size());
  std::size_t leaves = 0;
  for (std::size_t i = 0; i < tree.lights.size(); ++i) {
    EXPECT_EQ(params[i].skip, tree.skips[i]);
    if (tree.skips[i] == 1) {
      ++leaves;
      continue;
    }
    // Power adds up, and every part is within reach of the axis.
    const LightCone whole = coneOf(tree.lights[i]);
    double power = 0;
    for (std::size_t j = i + 1; j < i + tree.skips[i]; ++j) {
      if (tree.skips[j] > 1) continue;
      power += params[j].power.x;
      const LightCone part = coneOf(tree.lights[j]);
      EXPECT_LE(glm::length(part.axis - whole.axis) + 2 * std::sin(0.5 * part.half_angle_rad),
                tree.reaches[i] + 1e-5);
    }
    EXPECT_NEAR(params[i].power.x / power, 1, 1e-5);
  }
  EXPECT_EQ(leaves, lights.size());
}

// Of all walks, the one that stops at nothing sees every light once.
TEST(LightTree, PartsFollowTheirCone) {
  const LightTree tree = lightTree(ring(5));
  for (std::size_t i = 0; i < tree.lights.size(); ++i) {
    ASSERT_LE(i + tree.skips[i], tree.lights.size());
    if (tree.skips[i] == 1) continue;
    const std::size_t first = i + 1, second = first + tree.skips[first];
    EXPECT_EQ(second + tree.skips[second], i + tree.skips[i]);
  }
}

// What is 4 times as bright is another level, and no cone stands for both.
TEST(LightTree, BrightAndDimStayApart) {
  std::vector<ConeLight> lights = {cone(5), cone(5)};
  lights[1].irradiance = {100, 200, 300, 0};
  EXPECT_EQ(lightTree(lights).lights.size(), 2u);
  EXPECT_TRUE(lightTree({}).lights.empty());
}

}  // namespace
}  // namespace glintmark
