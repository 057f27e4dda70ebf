// The procedural meshes: sizes as in [ZK16] Table 1, sound frames, uvs fit for glints.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

constexpr double kCountTolerance = 0.02;  // the requirement of the benchmark
constexpr double kFrameTolerance = 1e-5;  // frames are floats
// Isotropic glints need uvs that are about isotropic: a footprint stretched further than this is
// the chart's doing. Poles and edges may exceed it on little area.
constexpr double kStretchLimit = 2.5;
constexpr double kStretchedAreaLimit = 0.03;
constexpr double kFlatUvShareLimit = 0.002;

struct TableRow {
  const char* scene;
  double triangles;
};

void PrintTo(const TableRow& row, std::ostream* out) {
  *out << row.scene;
}

class TableOneMeshes : public testing::TestWithParam<TableRow> {};

TEST_P(TableOneMeshes, CountAndFrames) {
  const TriangleMesh mesh = load(GetParam().scene).mesh;
  EXPECT_NEAR(mesh.triangleCount() / GetParam().triangles, 1, kCountTolerance);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  ASSERT_EQ(mesh.triangle_materials.size(), mesh.triangles.size());
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::dvec3 n = mesh.normals[v], t = glm::vec3(mesh.tangents[v]);
    const bool good = std::abs(glm::length(n) - 1) < kFrameTolerance &&
                      std::abs(glm::length(t) - 1) < kFrameTolerance &&
                      std::abs(glm::dot(n, t)) < kFrameTolerance &&
                      std::abs(std::abs(mesh.tangents[v].w) - 1) < kFrameTolerance;
    if (!good) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
}

/// One triangle's map from uv to space.
struct Chart {
  double area = 0;     // scene units squared
  double uv_area = 0;  // signed
  double stretch = 1;  // ratio of the map's singular values
  glm::dvec3 dpdu{0}, normal{0};
};

Chart chartOf(const TriangleMesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 p0 = mesh.positions[t.x];
  const glm::dvec3 e1 = glm::dvec3(mesh.positions[t.y]) - p0;
  const glm::dvec3 e2 = glm::dvec3(mesh.positions[t.z]) - p0;
  const glm::dmat2 uv(mesh.uvs[t.y] - mesh.uvs[t.x], mesh.uvs[t.z] - mesh.uvs[t.x]);
  Chart chart;
  chart.normal = glm::cross(e1, e2);
  chart.area = 0.5 * glm::length(chart.normal);
  chart.uv_area = 0.5 * glm::determinant(uv);
  if (chart.uv_area == 0) return chart;
  const glm::dmat2 inverse = glm::inverse(uv);
  chart.dpdu = e1 * inverse[0][0] + e2 * inverse[0][1];
  const glm::dvec3 dpdv = e1 * inverse[1][0] + e2 * inverse[1][1];
  const double a = glm::dot(chart.dpdu, chart.dpdu), b = glm::dot(chart.dpdu, dpdv);
  const double c = glm::dot(dpdv, dpdv);
  const double middle = 0.5 * (a + c), half = std::hypot(0.5 * (a - c), b);
  chart.stretch = std::sqrt((middle + half) / std::max(middle - half, 1e-300));
  return chart;
}

TEST_P(TableOneMeshes, ChartsAreUnmirroredAndNearlyIsotropic) {
  const TriangleMesh mesh = load(GetParam().scene).mesh;
  double area = 0, stretched_area = 0;
  std::size_t flat = 0, mirrored = 0, turned = 0, inside_out = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const Chart chart = chartOf(mesh, t);
    area += chart.area;
    if (chart.area == 0) continue;
    if (chart.uv_area == 0) ++flat;
    if (chart.uv_area < 0) ++mirrored;
    if (chart.stretch > kStretchLimit) stretched_area += chart.area;
    for (int k = 0; k < 3; ++k) {
      if (glm::dot(chart.dpdu, glm::dvec3(glm::vec3(mesh.tangents[t[k]]))) <= 0) ++turned;
      if (glm::dot(chart.normal, glm::dvec3(mesh.normals[t[k]])) <= 0) ++inside_out;
    }
  }
  const double corners = 3.0 * mesh.triangleCount();
  EXPECT_LT(flat / corners, kFlatUvShareLimit);
  EXPECT_LT(mirrored / corners, kFlatUvShareLimit);
  EXPECT_LT(turned / corners, kFlatUvShareLimit);
  EXPECT_LT(inside_out / corners, kFlatUvShareLimit);
  EXPECT_LT(stretched_area / area, kStretchedAreaLimit);
}

TEST_P(TableOneMeshes, AreTheSameEveryTime) {
  const TriangleMesh a = load(GetParam().scene).mesh, b = load(GetParam().scene).mesh;
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.tangents, b.tangents);
  EXPECT_EQ(a.uvs, b.uvs);
  EXPECT_EQ(a.triangles, b.triangles);
}

INSTANTIATE_TEST_SUITE_P(ZK16, TableOneMeshes,
                         testing::Values(TableRow{"screen_plane", 2}, TableRow{"snow", 32e3},
                                         TableRow{"dress", 100e3}, TableRow{"car", 570e3},
                                         TableRow{"sponza", 262e3}),
                         [](const auto& test) { return test.param.scene; });

// Every edge of the terrain has two triangles that run through it in opposite directions, except
// on the rim.
TEST(SceneMeshes, TerrainIsClosedButForItsRim) {
  const TriangleMesh mesh = load("snow").mesh;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  std::size_t rim = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    if (!edges.contains({edge.second, edge.first})) ++rim;
  }
  EXPECT_EQ(rim, 2u * (126 + 127));
}

TEST(SceneMeshes, PartsGoToTheirMaterials) {
  const Scene car = load("car");
  std::set<std::uint32_t> used(car.mesh.triangle_materials.begin(),
                               car.mesh.triangle_materials.end());
  EXPECT_EQ(used.size(), car.materials.size());
}

// The timings of Table 1 are per light.
TEST(SceneMeshes, TableOneScenesHaveOneLight) {
  for (const char* name : {"screen_plane", "snow", "dress", "car", "sponza"}) {
    EXPECT_EQ(load(name).lights.size(), 1u) << name;
  }
}

TEST(SceneMeshes, ClosestPartRuleCounts) {
  const TemporaryFolder folder;
  const std::string more = "[[material]]\nname = 'b'\n[[material]]\nname = 'c'\n";
  const auto material_of_plane = [&](const std::string& parts) {
    const std::string file =
        folder.write("scene.toml", sceneText("generator = 'plane'\nparts = " + parts) + more);
    return load(file).mesh.triangle_materials[0];
  };
  EXPECT_EQ(material_of_plane("{ '*' = 'b', 'pl*' = 'c' }"), 2u);
  EXPECT_EQ(material_of_plane("{ '*' = 'b', 'plan' = 'c' }"), 1u);
  EXPECT_EQ(material_of_plane("{ 'plane' = 'b', 'plane*' = 'c' }"), 1u);
  EXPECT_EQ(material_of_plane("{ 'disc' = 'b' }"), 0u);
}

TEST(SceneMeshes, UvScaleMultiplies) {
  const TriangleMesh once = load("screen_plane").mesh;
  const TriangleMesh twice = load("screen_plane", {"mesh.uv_scale=2"}).mesh;
  for (std::size_t v = 0; v < once.uvs.size(); ++v) EXPECT_EQ(twice.uvs[v], once.uvs[v] * 2.0);
}

TEST(SceneMeshes, UvOffsetIsAddedAfterTheScale) {
  const TriangleMesh once = load("screen_plane").mesh;
  const TriangleMesh moved =
      load("screen_plane", {"mesh.uv_scale=2", "mesh.uv_offset=[0.5, -3]"}).mesh;
  for (std::size_t v = 0; v < once.uvs.size(); ++v)
    EXPECT_EQ(moved.uvs[v], once.uvs[v] * 2.0 + glm::dvec2(0.5, -3));
}

// The carved disk's map is drawn around (0.5, 0.5): one whole disk lies on its plane.
TEST(SceneMeshes, TheDiskIsOneDisk) {
  const TriangleMesh disk = load("disk").mesh;
  for (const glm::dvec2& uv : disk.uvs)
    for (int axis = 0; axis < 2; ++axis) EXPECT_TRUE(uv[axis] == 0 || uv[axis] == 1) << uv[axis];
}

TEST(CarMesh, WallsStandBehindTheCarAndFaceIt) {
  const Scene scene = load("mixed");
  const auto wall = std::ranges::find(scene.materials, "wall", &Material::name);
  const auto index = static_cast<std::uint32_t>(wall - scene.materials.begin());
  std::size_t triangles = 0;
  for (std::size_t t = 0; t < scene.mesh.triangleCount(); ++t) {
    if (scene.mesh.triangle_materials[t] != index) continue;
    ++triangles;
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = scene.mesh.triangles[t][corner];
      const glm::vec3 p = scene.mesh.positions[v], n = scene.mesh.normals[v];
      EXPECT_NEAR(glm::dot(n, p), -3.2, 1e-5) << "distance to the car's middle";
    }
  }
  EXPECT_EQ(triangles, 2u * 2u * 16u * 16u);
}

}  // namespace
}  // namespace glintmark
