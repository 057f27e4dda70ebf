// The scenes of Table 1, and the real Crytek Sponza where it is at hand, against Embree.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host/scene/load_scene.h"
#include "tests/raster/embree_oracle.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark::test {
namespace {

// Real models have faces on top of each other, where either may win; more would be a bug.
constexpr double kMostTies = 0.01;
// Pixels whose centre lies within 0.01 px of an edge: two sides of each triangle of about 1 px.
constexpr double kMostEdgePixels = 0.05;

void expectSameTriangles(const Scene& scene, const std::string& view_name) {
  SCOPED_TRACE(scene.name + "/" + view_name);
  const Camera camera = makeCamera(scene.view(view_name), 480, 270);
  std::vector<std::uint32_t> ids;
  Rasterizer().renderVisibility(scene.mesh, camera, false, ids);
  const EmbreeOracle oracle(scene.mesh);
  const VisibilityComparison c = compareWithEmbree(oracle, scene.mesh, camera, ids);
  EXPECT_EQ(c.wrong, 0u) << "for example at " << c.wrong_x << ", " << c.wrong_y;
  EXPECT_LE(static_cast<double>(c.edge), kMostEdgePixels * static_cast<double>(c.pixels));
  EXPECT_LE(static_cast<double>(c.tie), kMostTies * static_cast<double>(c.pixels));
}

class Table1Scene : public testing::TestWithParam<const char*> {};

TEST_P(Table1Scene, ShowsTheTrianglesThatEmbreeFinds) {
  const Scene scene = loadScene({GetParam(), {}, {}, {}});
  expectSameTriangles(scene, "steep");
  expectSameTriangles(scene, "grazing");
}

INSTANTIATE_TEST_SUITE_P(All, Table1Scene,
                         testing::Values("screen_plane", "snow", "dress", "car", "sponza"));

// Stands in for the real Sponza, which is not everywhere: thousands of triangles of all sizes that
// cross each other, some of them twice, seen from outside and from among them.
TEST(StandInForRealSponza, ShowsTheTrianglesThatEmbreeFinds) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  Scene scene = loadScene({"screen_plane", {}, {}, {}});
  scene.name = "soup";
  TriangleMesh& mesh = scene.mesh;
  mesh = TriangleMesh{};
  constexpr std::uint32_t kTriangles = 4000;
  for (std::uint32_t k = 0; k < kTriangles; ++k) {
    const glm::vec3 centre(2 * normal(random), 2 * normal(random), 2 * normal(random));
    const float size = std::exp2(3 * normal(random) - 4);
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3 off(normal(random), normal(random), normal(random));
      mesh.positions.push_back(centre + size * off);
      mesh.normals.push_back({0, 1, 0});
      mesh.tangents.push_back({1, 0, 0, 1});
      mesh.uvs.push_back({0, 0});
    }
    mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    if (k % 97 == 0) mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  View view = scene.views[0];
  view.target = {0, 0, 0};
  view.up = {0, 1, 0};
  scene.views.clear();
  for (const auto& [name, eye] :
       {std::pair{"outside", glm::dvec3(7, 4, 9)}, std::pair{"among", glm::dvec3(0.3, 0.2, 1)}}) {
    view.name = name;
    view.eye = eye;
    scene.views.push_back(view);
    expectSameTriangles(scene, name);
  }
}

TEST(RealSponza, ShowsTheTrianglesThatEmbreeFinds) {
  const auto folder = dataFolder();
  if (!folder) GTEST_SKIP() << "no folder of real models; GLINTMARK_DATA names one";
  const Scene scene = loadScene({"sponza", {}, {}, *folder});
  for (const View& view : scene.views) expectSameTriangles(scene, view.name);
}

}  // namespace
}  // namespace glintmark::test
