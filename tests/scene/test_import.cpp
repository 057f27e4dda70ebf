// Mesh files: what is repaired, what is refused, and real models where they are at hand.
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
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
  EXPECT_EQ(mesh.mesh.uvs[2], glm::dvec2(1, 0));  // v runs up in the file, down in maps
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

TEST(Import, FilesWithoutUvsGetThoseThatAreAskedFor) {
  const TemporaryFolder folder;
  // Two sides of a box, in units of its longest side.
  const std::string file = folder.write(
      "box.obj", "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 4 0 -2\nv 4 2 -2\nf 1 2 3 4\nf 2 5 6 3\n");
  const auto areas = [](const TriangleMesh& mesh) {
    std::vector<double> sizes;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec2 a = mesh.uvs[t.y] - mesh.uvs[t.x], b = mesh.uvs[t.z] - mesh.uvs[t.x];
      sizes.push_back(std::abs(a.x * b.y - a.y * b.x) / 2);
    }
    return sizes;
  };
  const PartMesh box = importMesh(file), planar = importMesh(file, {.uv = UvProjection::kPlanar});
  ASSERT_EQ(box.notes.size(), 1u);
  expectMessage(box.notes[0], {"box.obj has no uvs and got box ones"});
  expectMessage(planar.notes[0], {"got planar ones"});
  EXPECT_EQ(areas(box.mesh), (std::vector<double>{0.25, 0.25, 0.125, 0.125}));
  EXPECT_EQ(areas(planar.mesh), (std::vector<double>{0.25, 0.25, 0, 0}));
  SceneRequest request;
  request.mesh_file = file;
  request.scene = folder.write("scene.toml", sceneText("generator = \"plane\"\nuv = \"round\""));
  expectMessage(errorOf([&] { loadScene(request); }),
                {"mesh.uv is 'round'", "auto, planar or box"});
}

TEST(Import, UvsWithoutAreaAreSaidAndSpread) {
  const TemporaryFolder folder;
  const PartMesh mesh = importMesh(folder.write(
      "point.obj",
      std::string(kPositions) + "vt 0.5 0.5\nvt 0 0\nvt 0 1\nf 1/1 2/1 3/1\nf 1/1 3/2 4/3\n"));
  ASSERT_EQ(mesh.notes.size(), 1u);
  expectMessage(mesh.notes[0], {"1 of 2 triangles in point.obj have uvs without area", "mean"});
  // So wide that a pixel holds thousands of units; the neighbour keeps its own.
  const glm::uvec3 flat = mesh.mesh.triangles[0], other = mesh.mesh.triangles[1];
  EXPECT_GT(glm::distance(mesh.mesh.uvs[flat.x], mesh.mesh.uvs[flat.z]), 1e6);
  EXPECT_EQ(mesh.mesh.uvs[other.x], glm::dvec2(0.5, 0.5));
}

TEST(Import, TrianglesWithoutAreaAreLeftOut) {
  const TemporaryFolder folder;
  const std::string base = std::string(kPositions) + kUvs + "v nan 0 0\n";
  const PartMesh mesh =
      importMesh(folder.write("a.obj", base + "f 1/1 2/2 3/3\nf 1/1 1/1 2/2\nf 1/1 2/2 2/3\n"));
  EXPECT_EQ(mesh.mesh.triangleCount(), 1u);
  EXPECT_EQ(mesh.mesh.positions.size(), 3u);  // not the one that no triangle names
  ASSERT_EQ(mesh.notes.size(), 1u);
  expectMessage(mesh.notes[0], {"2 of 3 triangles of a.obj have no area"});
  expectMessage(importError(folder.write("b.obj", base + "f 1/1 1/1 2/2\n")),
                {"b.obj", "no triangle of the mesh has an area"});
}

/// A wavy strip of 2 x 8 quads at a place and of a size.
std::string stripObj(double scale, const glm::dvec3& place) {
  std::string text;
  char line[200];
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 2; ++j) {
      const double x = place.x + scale * i / 8, y = place.y + scale * 0.05 * ((i * 3) % 5),
                   z = place.z + scale * j / 8;
      std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\nvt %g %g\n", x, y, z, i / 8.0,
                    j / 8.0);
      text += line;
    }
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 2; ++j) {
      const int a = 3 * i + j + 1;
      std::snprintf(line, sizeof line, "f %d/%d %d/%d %d/%d %d/%d\n", a, a, a + 1, a + 1, a + 4,
                    a + 4, a + 3, a + 3);
      text += line;
    }
  return text;
}

TEST(Import, AnyUnitAndPlaceIsTheSameMesh) {
  const TemporaryFolder folder;
  const ImportOptions free{.place_freely = true};
  const TriangleMesh wanted = importMesh(folder.write("a.obj", stripObj(1, {0, 0, 0}))).mesh;
  const std::pair<double, glm::dvec3> cases[] = {{1e-12, {0, 0, 0}},  {1e-8, {0, 0, 0}},
                                                 {1e12, {0, 0, 0}},   {1, {5e5, 120, -4.5e6}},
                                                 {1e-3, {1e4, 0, 0}}, {1e12, {1e14, 0, 0}}};
  for (const auto& [scale, place] : cases) {
    const PartMesh mesh = importMesh(folder.write("b.obj", stripObj(scale, place)), free);
    ASSERT_EQ(mesh.mesh.positions.size(), wanted.positions.size()) << scale;
    EXPECT_FALSE(mesh.notes.empty());
    const glm::dvec3 origin = mesh.mesh.positions[0], from = wanted.positions[0];
    const double size = scale > 1e6 || scale < 1e-3 ? 1 : scale;
    // What doubles of that place hold of the file's numbers.
    const double tolerance = 1e-6 + 4e-16 * glm::length(place) / scale;
    for (std::size_t v = 0; v < wanted.positions.size(); ++v) {
      const glm::dvec3 p = (glm::dvec3(mesh.mesh.positions[v]) - origin) / size;
      EXPECT_LT(glm::distance(p, glm::dvec3(wanted.positions[v]) - from), tolerance) << scale;
      EXPECT_LT(glm::distance(mesh.mesh.normals[v], wanted.normals[v]), 100 * tolerance) << scale;
    }
    // A scene's own cameras know where its own file is.
    if (scale == 1) {
      EXPECT_EQ(importMesh(folder.path() / "b.obj").mesh.positions[0], glm::vec3(place));
    }
  }
}

TEST(Import, FittedViewsFollowTheSize) {
  const TemporaryFolder folder;
  SceneRequest request;
  request.scene = "snow";
  request.mesh_file = folder.write("a.obj", stripObj(1, {0, 0, 0}));
  const View one = loadScene(request).view("steep");
  request.mesh_file = folder.write("b.obj", stripObj(1e-2, {0, 0, 0}));
  const View small = loadScene(request).view("steep");
  EXPECT_NEAR(glm::distance(one.eye, one.target), 100 * glm::distance(small.eye, small.target),
              1e-3);
  EXPECT_NEAR(one.near_plane, 100 * small.near_plane, 1e-8);
}

TEST(Import, WhatHasNoEndIsRefused) {
  for (const char* file : {"/dev/zero", "/dev/null"}) {
    SceneRequest request;
    request.scene = "snow";
    request.mesh_file = file;
    expectMessage(errorOf([&] { loadScene(request); }), {file, "is a device"});
  }
  const TemporaryFolder folder;
  for (const char* name : {"a.obj", "a.ply", "a.gltf", "a.stl"}) {
    const std::filesystem::path pipe = folder.path() / name;
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    expectMessage(errorOf([&] { importMesh(pipe); }), {name, "a pipe"});
  }
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

// Every vertex has a frame, and no triangle was lost.
void expectWhole(const Scene& scene, std::size_t triangles) {
  EXPECT_EQ(scene.mesh.triangleCount(), triangles);
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

// A bumpy sheet of kSheet x kSheet vertices whose second half has no uvs.
constexpr int kSheet = 60;
constexpr std::size_t kSheetTriangles = 2 * (kSheet - 1) * (kSheet - 1);

std::string sheetText() {
  std::string text;
  for (int y = 0; y < kSheet; ++y)
    for (int x = 0; x < kSheet; ++x)
      text += "v " + std::to_string(x) + " " +
              std::to_string(3 * std::sin(0.4 * x) * std::cos(0.3 * y)) + " " + std::to_string(y) +
              "\nvt " + std::to_string(0.1 * x) + " " + std::to_string(0.1 * y) + "\n";
  text += "usemtl first\n";
  for (int y = 0; y + 1 < kSheet; ++y) {
    if (y == kSheet / 2) text += "usemtl second\n";
    for (int x = 0; x + 1 < kSheet; ++x) {
      text += "f";
      for (const int corner :
           {y * kSheet + x, (y + 1) * kSheet + x, (y + 1) * kSheet + x + 1, y * kSheet + x + 1}) {
        text += " " + std::to_string(corner + 1);
        if (y < kSheet / 2) text += "/" + std::to_string(corner + 1);
      }
      text += "\n";
    }
  }
  return text;
}

// Stands in for the real models below, which are not everywhere.
TEST(StandInModel, Loads) {
  const TemporaryFolder folder;
  SceneRequest request;
  request.scene = "screen_plane";
  request.mesh_file = folder.write("sheet.obj", sheetText());
  const Scene scene = loadScene(request);
  expectWhole(scene, kSheetTriangles);
  EXPECT_TRUE(std::ranges::any_of(scene.notes, [](const std::string& n) {
    return n.find("have no uvs") != std::string::npos;
  }));
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
  expectWhole(loadScene(request), GetParam().triangles);
}

INSTANTIATE_TEST_SUITE_P(All, RealModels,
                         testing::Values(RealModel{"sponza/Sponza.gltf", 262087},
                                         RealModel{"carconcept/CarConcept.gltf", 213270},
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
  EXPECT_EQ(car.mesh.triangleCount(), 213270u);
  const auto said = [&](const std::string& text) {
    return std::ranges::any_of(
        car.notes, [&](const std::string& n) { return n.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(said("10552 of 213270 triangles have no uvs"));
  EXPECT_TRUE(said("materials of CarConcept.gltf were not used"));
}

}  // namespace
}  // namespace glintmark
