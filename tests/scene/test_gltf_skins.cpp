// Skins of glTF files: where joints at rest put what hangs on them.
#include <cmath>
#include <numbers>

#include "tests/scene/gltf_text.h"

namespace glintmark {
namespace {

/// The quad whose lower edge hangs on joint 0 and whose upper edge hangs on joint 1, nodes 1 and 2,
/// below a node 3 that is no joint. The mesh's own node would move it.
GltfText skinnedQuad() {
  GltfText text = quadText();
  const int joints =
      text.add<std::uint8_t>("VEC4", 5121, 4, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  const int weights = text.add<std::uint8_t>(
      "VEC4", 5121, 4, {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, 0, true);
  text.primitive()["attributes"]["JOINTS_0"] = joints;
  text.primitive()["attributes"]["WEIGHTS_0"] = weights;
  text.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {7, 0, 0}}},
                        {{"name", "lower"}},
                        {{"name", "upper"}},
                        {{"children", {1, 2}}}};
  text.json["scenes"] = {{{"nodes", {0, 3}}}};
  text.json["skins"] = {{{"joints", {1, 2}}}};
  return text;
}

/// Positions of the quad's corners by their uvs, which are the corners of the bound quad.
glm::vec3 cornerOf(const TriangleMesh& mesh, float u, float v) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.uvs[i] == glm::dvec2(u, v)) return mesh.positions[i];
  ADD_FAILURE() << "no corner " << u << " " << v;
  return {};
}

void expectCorner(const TriangleMesh& mesh, float u, float v, const glm::vec3& wanted) {
  const glm::vec3 found = cornerOf(mesh, u, v);
  EXPECT_LT(glm::distance(found, wanted), 1e-6f)
      << u << " " << v << ": " << found.x << " " << found.y << " " << found.z;
}

TEST(GltfSkins, JointsNotNodesMoveTheMesh) {
  const PartMesh mesh = gltf(skinnedQuad());
  for (const float u : {0.0f, 1.0f})
    for (const float v : {0.0f, 1.0f}) expectCorner(mesh.mesh, u, v, {u, v, 0});
  ASSERT_EQ(mesh.notes.size(), 1u);
  expectMessage(mesh.notes[0], {"1 of mesh.gltf", "skinned", "joints have at rest"});
}

TEST(GltfSkins, ThePoseIsThatOfTheNodes) {
  GltfText text = skinnedQuad();
  text.json["nodes"][3]["scale"] = {2, 2, 2};
  text.json["nodes"][2]["translation"] = {0, 0, 5};
  const double half = std::sqrt(0.5);  // a quarter turn about x: y to z
  text.json["nodes"][1]["rotation"] = {half, 0, 0, half};
  const TriangleMesh mesh = gltf(text).mesh;
  expectCorner(mesh, 1, 0, {2, 0, 0});
  expectCorner(mesh, 1, 1, {2, 2, 10});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 wanted = mesh.uvs[v].y == 0 ? glm::vec3(0, -1, 0) : glm::vec3(0, 0, 1);
    EXPECT_LT(glm::distance(mesh.normals[v], wanted), 1e-6f) << v;
  }
}

// Joints at the height of what hangs on them, and the same a hundred times as large: what is bound
// at rest stands where it was bound.
TEST(GltfSkins, InverseBindMatricesUndoThePlacesOfJoints) {
  for (const float size : {1.0f, 100.0f}) {
    GltfText text = skinnedQuad();
    text.json["nodes"][3]["scale"] = {size, size, size};
    text.json["nodes"][1]["translation"] = {3, 0, 0};
    text.json["nodes"][2]["translation"] = {0, 1, 0};
    const float s = 1 / size;
    text.json["skins"][0]["inverseBindMatrices"] =
        text.add<float>("MAT4", 5126, 2, {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, -3, 0,  0, 1,
                                          s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0,  -1, 0, 1});
    const TriangleMesh mesh = gltf(text).mesh;
    for (const float u : {0.0f, 1.0f})
      for (const float v : {0.0f, 1.0f}) expectCorner(mesh, u, v, {u, v, 0});
  }
}

TEST(GltfSkins, WeightsBlendJointsOfAllSets) {
  GltfText text = skinnedQuad();
  text.json["nodes"][1]["translation"] = {0, 0, 1};
  text.json["nodes"][2]["translation"] = {0, 0, 9};
  // A quarter of joint 0 and three quarters of joint 1, in the second set, written as bytes.
  const std::vector<std::uint16_t> joints = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const std::vector<std::uint8_t> quarter = {64, 0, 0, 0, 64, 0, 0, 0, 64, 0, 0, 0, 64, 0, 0, 0};
  std::vector<std::uint8_t> rest = quarter;
  for (std::uint8_t& weight : rest) weight = static_cast<std::uint8_t>(3 * weight);
  text.primitive()["attributes"]["WEIGHTS_0"] = text.add("VEC4", 5121, 4, quarter, 0, true);
  text.primitive()["attributes"]["JOINTS_1"] = text.add("VEC4", 5123, 4, joints);
  text.primitive()["attributes"]["WEIGHTS_1"] = text.add("VEC4", 5121, 4, rest, 0, true);
  const TriangleMesh mesh = gltf(text).mesh;
  expectCorner(mesh, 0, 0, {0, 0, 7});
  expectCorner(mesh, 0, 1, {0, 1, 9});  // its first set has joint 1 too
}

TEST(GltfSkins, WithoutWeightTheFirstJointHolds) {
  GltfText text = skinnedQuad();
  text.json["nodes"][2]["translation"] = {0, 0, 9};
  text.primitive()["attributes"]["WEIGHTS_0"] =
      text.add("VEC4", 5121, 4, std::vector<std::uint8_t>(16, 0), 0, true);
  expectCorner(gltf(text).mesh, 0, 1, {0, 1, 9});
}

TEST(GltfSkins, MirroringJointsKeepTheFront) {
  GltfText text = skinnedQuad();
  text.json["nodes"][3]["scale"] = {1, -1, 1};
  const TriangleMesh mesh = gltf(text).mesh;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 p = mesh.positions[t.x];
    const glm::vec3 front = glm::cross(mesh.positions[t.y] - p, mesh.positions[t.z] - p);
    EXPECT_GT(front.z, 0);
    EXPECT_EQ(mesh.normals[t.x], glm::vec3(0, 0, 1));
  }
}

TEST(GltfSkins, AMeshWithoutJointsIsMovedByItsNode) {
  GltfText text = skinnedQuad();
  text.primitive()["attributes"].erase("JOINTS_0");
  expectCorner(gltf(text).mesh, 0, 0, {7, 0, 0});
}

TEST(GltfSkins, WhatIsWrongIsSaid) {
  const auto changed = [](const std::function<void(GltfText&)>& change) {
    GltfText text = skinnedQuad();
    change(text);
    return gltfError(text);
  };
  expectMessage(changed([](GltfText& t) { t.json["nodes"][0]["skin"] = 4; }),
                {"there is no 4 in its skins"});
  expectMessage(changed([](GltfText& t) { t.json["skins"][0].erase("joints"); }),
                {"skin 0 has no joints"});
  expectMessage(changed([](GltfText& t) {
                  t.json["skins"][0]["joints"] = {1, 9};
                }),
                {"there is no 9 in its nodes"});
  expectMessage(changed([](GltfText& t) { t.json["skins"][0]["joints"] = {1}; }),
                {"vertex 2", "joint 1", "its skin has 1"});
  expectMessage(changed([](GltfText& t) { t.json["skins"][0]["inverseBindMatrices"] = 0; }),
                {"skin 0", "2 joints", "4 inverse bind matrices of 3 numbers"});
  expectMessage(
      changed([](GltfText& t) {
        t.primitive()["attributes"]["WEIGHTS_0"] = t.add<float>("VEC4", 5126, 1, {1, 0, 0, 0});
      }),
      {"4 positions", "1 weights"});
  expectMessage(changed([](GltfText& t) {
                  t.json["nodes"][1]["children"] = {3};
                  t.json["scenes"] = {{{"nodes", {0}}}};
                }),
                {"joint 1 is its own ancestor"});
}

}  // namespace
}  // namespace glintmark
