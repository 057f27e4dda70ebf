// The scenes of Table 1, and the real Crytek Sponza where it is at hand, against Embree.
#include <gtest/gtest.h>

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

TEST(RealSponza, ShowsTheTrianglesThatEmbreeFinds) {
  const auto folder = dataFolder();
  if (!folder) GTEST_SKIP() << "no folder of real models; GLINTMARK_DATA names one";
  const Scene scene = loadScene({"sponza", {}, {}, *folder});
  for (const View& view : scene.views) expectSameTriangles(scene, view.name);
}

}  // namespace
}  // namespace glintmark::test
