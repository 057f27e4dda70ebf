// A normal map between its texels.
#include <gtest/gtest.h>

#include "host/filter/interpolated_normals.h"
#include "host/filter/normal_map_generators.h"

namespace glintmark {
namespace {

TEST(InterpolatedNormals, FactorOneIsTheMap) {
  const NormalMap map = generateNormalMap({.kind = "bumps", .size_px = 16});
  const NormalMap same = interpolatedNormals(map, 1);
  ASSERT_EQ(same.normals.size(), map.normals.size());
  for (std::size_t i = 0; i < map.normals.size(); ++i)
    EXPECT_LT(glm::distance(same.normals[i], map.normals[i]), 1e-6f) << i;
}

TEST(InterpolatedNormals, LieAQuarterTexelFromTheTexels) {
  const glm::vec3 a = glm::normalize(glm::vec3(0.4f, 0, 1)), b(0, 0, 1);
  const NormalMap map{"two", 2, 1, {a, b}};
  const NormalMap fine = interpolatedNormals(map, 2);
  ASSERT_EQ(fine.width_px, 4);
  ASSERT_EQ(fine.height_px, 2);
  const glm::vec3 near_a = glm::normalize(0.75f * a + 0.25f * b);
  const glm::vec3 near_b = glm::normalize(0.25f * a + 0.75f * b);
  for (int y = 0; y < 2; ++y) {
    EXPECT_LT(glm::distance(fine.at(0, y), near_a), 1e-6f) << "the map repeats";
    EXPECT_LT(glm::distance(fine.at(1, y), near_a), 1e-6f);
    EXPECT_LT(glm::distance(fine.at(2, y), near_b), 1e-6f);
    EXPECT_LT(glm::distance(fine.at(3, y), near_b), 1e-6f);
  }
}

TEST(InterpolatedNormals, OppositesThatCancelPointUp) {
  const NormalMap map{"flat", 2, 1, {{1, 0, 0}, {-1, 0, 0}}};
  for (const glm::vec3& n : interpolatedNormals(map, 3).normals)
    EXPECT_NEAR(glm::length(n), 1, 1e-6f);
}

}  // namespace
}  // namespace glintmark
