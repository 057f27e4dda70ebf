// Mesh files: what is repaired, what is refused, and real models where they are at hand.
#include <cmath>
#include <limits>

#include "host/scene/import_mesh.h"
#include "host/scene/mesh_checks.h"
#include "host/scene/mesh_frames.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

// Normals and tangents are floats.
constexpr double kImportTolerance = 1e-5;

constexpr const char* kPositions = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
constexpr const char* kUvs = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

std::string importError(const std::string& file) {
  return errorOf([&] { importMesh(file); });
}

TEST(Import, QuadBecomesTrianglesWithSmoothNormals) {
  const TemporaryFolder folder;
  const PartMesh mesh =
      importMesh(folder.write("quad.obj", std::string(kPositions) + kUvs + "f 1/1 2/2 3/3 4/4\n"));
  EXPECT_EQ(mesh.mesh.triangleCount(), 2u);
  for (const glm::vec3& normal : mesh.mesh.normals) EXPECT_NEAR(normal.z, 1, kImportTolerance);
  EXPECT_EQ(mesh.mesh.uvs[2], glm::dvec2(1, 1));
}

TEST(Import, UvSeamsStayOpen) {
  const TemporaryFolder folder;
  // Two triangles share an edge in space but not in uv.
  const PartMesh mesh = importMesh(folder.write("seam.obj", std::string(kPositions) + kUvs +
                                                                "vt 5 5\nvt 6 6\nvt 5 6\n" +
                                                                "f 1/1 2/2 3/3\nf 1/5 3/6 4/7\n"));
  EXPECT_EQ(mesh.mesh.positions.size(), 6u);
}

TEST(Import, BadFiles) {
  const TemporaryFolder folder;
  const std::string base = std::string(kPositions) + kUvs;
  expectMessage(importError(folder.write("a.obj", std::string(kPositions) + "f 1 2 3\n")),
                {"a.obj: the mesh has no uvs"});
  expectMessage(importError(folder.write("b.obj", base + "f 1/1 2/2 9/3\n")),
                {"b.obj", "index out of range"});
  expectMessage(importError(folder.write("c.obj", "v 0 0 0\nv 1 nan 0\nv 1 1 0\n" +
                                                      std::string(kUvs) + "f 1/1 2/2 3/3\n")),
                {"c.obj: the position of vertex 1 is not finite"});
  expectMessage(importError(folder.write("d.obj", base + "p 1\n")), {"d.obj: the mesh has no tri"});
  expectMessage(importError(folder.write("e.obj", "nonsense")), {"e.obj: cannot be read"});
  expectMessage(importError(folder.write("f.ply", "")), {"f.ply: cannot be read"});
  expectMessage(importError(folder.write("g.xyz", "1 2 3")), {"g.xyz: cannot be read"});
}

std::string plyText(const std::string& second_uv, const std::string& last_index) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nproperty float s\nproperty float t\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 " +
         second_uv + " 0\n0 1 0 0 1\n3 0 1 " + last_index + "\n";
}

TEST(Import, BadPly) {
  const TemporaryFolder folder;
  EXPECT_EQ(importMesh(folder.write("good.ply", plyText("1", "2"))).mesh.triangleCount(), 1u);
  expectMessage(importError(folder.write("index.ply", plyText("1", "7"))),
                {"index.ply: face 0", "names vertex 7, but there are only 3"});
  expectMessage(importError(folder.write("nan.ply", plyText("nan", "2"))),
                {"nan.ply: the uv of vertex 1 is not finite"});
}

TEST(Import, PartsWithoutUvsGetPlanarOnes) {
  const TemporaryFolder folder;
  const PartMesh mesh = importMesh(folder.write(
      "mixed.obj", std::string(kPositions) + kUvs + "g a\nf 1/1 2/2 3/3\ng b\nf 1 3 4\n"));
  ASSERT_EQ(mesh.notes.size(), 1u);
  expectMessage(mesh.notes[0], {"1 of 2 triangles have no uvs"});
}

TEST(Import, MissingMesh) {
  SceneRequest request;
  request.scene = "snow";
  request.mesh_file = "nowhere.obj";
  expectMessage(errorOf([&] { loadScene(request); }), {"no mesh file nowhere.obj"});
  request.mesh_file.clear();
  request.overrides = {"mesh.file=nowhere.obj"};
  expectMessage(errorOf([&] { loadScene(request); }), {"no mesh file nowhere.obj"});
  request.overrides.clear();
  request.asset_folder = "no/such/folder";
  request.scene = "car";
  expectMessage(errorOf([&] { loadScene(request); }), {"no asset folder no/such/folder"});
}

TEST(Import, AbsentAssetFallsBackWithANote) {
  const TemporaryFolder folder;
  SceneRequest request;
  request.scene = "car";
  request.asset_folder = folder.path();
  request.overrides = {"mesh.detail=0.1"};
  const Scene scene = loadScene(request);
  ASSERT_EQ(scene.notes.size(), 1u);
  expectMessage(scene.notes[0], {"CarConcept.gltf is not in", "stands in"});
}

TEST(Import, StrangersMeshIsFramed) {
  const TemporaryFolder folder;
  SceneRequest request;
  request.scene = "snow";
  request.mesh_file =
      folder.write("quad.obj", std::string(kPositions) + kUvs + "f 1/1 2/2 3/3 4/4\n");
  const Scene scene = loadScene(request);
  const View& steep = scene.view("steep");
  const glm::dvec3 axis = glm::normalize(steep.target - steep.eye);
  EXPECT_NEAR(axis.z, -1, 1e-9);  // the quad faces +z
  EXPECT_EQ(steep.target, glm::dvec3(0.5, 0.5, 0));
  const View& grazing = scene.view("grazing");
  EXPECT_NEAR(-glm::normalize(grazing.target - grazing.eye).z, std::sin(glm::radians(10.0)), 1e-9);
}

TEST(MeshChecks, NameTheVertex) {
  TriangleMesh mesh;
  expectMessage(errorOf([&] { checkMesh(mesh, "x"); }), {"x: the mesh has no triangles"});
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.triangles = {{0, 1, 3}};
  expectMessage(errorOf([&] { checkMesh(mesh, "x"); }), {"triangle 0 names vertex 3"});
  mesh.triangles = {{0, 1, 2}};
  checkMesh(mesh, "x");
  mesh.normals[2].y = std::numeric_limits<float>::infinity();
  expectMessage(errorOf([&] { checkMesh(mesh, "x"); }), {"the normal of vertex 2"});
}

TEST(MeshFrames, MirroredTrianglesAreSplitOff) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 0}};  // the left half repeats the right one, mirrored
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  computeTangents(mesh);
  ASSERT_EQ(mesh.positions.size(), 6u);
  for (const int k : {0, 1, 2}) {
    EXPECT_EQ(mesh.tangents[mesh.triangles[0][k]], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(mesh.tangents[mesh.triangles[1][k]], glm::vec4(-1, 0, 0, -1));
  }
}

TEST(MeshFrames, NoUvAreaStillGivesAFrame) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.uvs.assign(3, {0.5, 0.5});
  mesh.triangles = {{0, 1, 2}};
  computeTangents(mesh);
  for (const glm::vec4& tangent : mesh.tangents) {
    EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1, kImportTolerance);
    EXPECT_NEAR(tangent.z, 0, kImportTolerance);
  }
}

struct RealModel {
  const char* file;
  std::size_t triangles;
};

void PrintTo(const RealModel& model, std::ostream* out) {
  *out << model.file;
}

class RealModels : public testing::TestWithParam<RealModel> {};

TEST_P(RealModels, Load) {
  const auto folder = dataFolder();
  if (!folder || !std::filesystem::exists(*folder / GetParam().file)) {
    GTEST_SKIP() << GetParam().file << " is not here; GLINTMARK_DATA names its folder";
  }
  SceneRequest request;
  request.scene = "screen_plane";
  request.mesh_file = *folder / GetParam().file;
  const Scene scene = loadScene(request);
  EXPECT_EQ(scene.mesh.triangleCount(), GetParam().triangles);
  EXPECT_EQ(scene.mesh.tangents.size(), scene.mesh.positions.size());
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
    const glm::dvec3 n = scene.mesh.normals[v], t = glm::vec3(scene.mesh.tangents[v]);
    if (std::abs(glm::length(n) - 1) > kImportTolerance) ++wrong;
    if (std::abs(glm::length(t) - 1) > kImportTolerance) ++wrong;
    if (std::abs(glm::dot(n, t)) > kImportTolerance) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RealModels,
                         testing::Values(RealModel{"sponza/Sponza.gltf", 262087},
                                         RealModel{"carconcept/CarConcept.gltf", 213347},
                                         RealModel{"toycar/ToyCar.gltf", 108936},
                                         RealModel{"sheencloth/SheenCloth.gltf", 115200},
                                         RealModel{"drapedcloth/cloth.ply", 131072},
                                         RealModel{"spot/spot.obj", 5856}));

TEST(RealModels, ReplaceTheProceduralOnes) {
  const auto folder = dataFolder();
  if (!folder) GTEST_SKIP() << "no folder of real models; GLINTMARK_DATA names one";
  SceneRequest request;
  request.asset_folder = *folder;
  request.scene = "sponza";
  const Scene sponza = loadScene(request);
  EXPECT_EQ(sponza.mesh.triangleCount(), 262087u);
  std::vector<std::size_t> uses(sponza.materials.size(), 0);
  for (const std::uint32_t material : sponza.mesh.triangle_materials) ++uses[material];
  for (std::size_t i = 0; i < uses.size(); ++i) EXPECT_GT(uses[i], 0u) << sponza.materials[i].name;
  // Its cameras are others than those of the arcade.
  EXPECT_GT(glm::distance(sponza.view("steep").eye, load("sponza").view("steep").eye), 1);

  request.scene = "car";
  const Scene car = loadScene(request);
  EXPECT_EQ(car.mesh.triangleCount(), 213347u);
  ASSERT_EQ(car.notes.size(), 1u);
  expectMessage(car.notes[0], {"10552 of 213347 triangles have no uvs"});
}

}  // namespace
}  // namespace glintmark
