// glTF files that ask for more than they hold: depth, memory, numbers of parts.
#include <sys/resource.h>

#include <fstream>

#include "tests/scene/gltf_text.h"

namespace glintmark {
namespace {

TEST(Gltf, BracketsInBracketsAreRefused) {
  const TemporaryFolder folder;
  const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
  for (const std::string place : {R"("nodes":[{"mesh":)", R"("scenes":[{"nodes":)"}) {
    const std::string file =
        folder.write("deep.gltf", R"({"asset":{"version":"2.0"},)" + place + deep + "}]}");
    expectMessage(errorOf([&] { importMesh(file); }), {"deep.gltf", "more brackets in brackets"});
  }
  // What names nothing is shown in part.
  GltfText text = quadText();
  text.json["nodes"][0]["mesh"] = std::vector<int>(100000, 7);
  const std::string error = gltfError(text);
  expectMessage(error, {"there is no [7,7,7,", "... in its meshes"});
  EXPECT_LT(error.size(), 400u);
}

TEST(Gltf, ManyNodesOfOneMeshTakeNoMoreMemoryThanIsFree) {
  constexpr std::size_t kVertices = 20000, kNodes = 200;
  GltfText text = quadText();
  text.primitive()["attributes"] = {
      {"POSITION", text.add<float>("VEC3", 5126, kVertices, std::vector<float>(3 * kVertices))}};
  text.primitive().erase("indices");
  text.json["nodes"] = Json::array();
  for (std::size_t i = 0; i < kNodes; ++i) {
    text.json["scenes"][0]["nodes"][i] = i;
    text.json["nodes"].push_back({{"mesh", 0}});
  }
  rlimit before = {};
  getrlimit(RLIMIT_AS, &before);
  std::ifstream pages_file("/proc/self/statm");
  std::uint64_t pages = 0;
  pages_file >> pages;
  const rlimit less = {pages * 4096 + (std::uint64_t{300} << 20), before.rlim_max};
  setrlimit(RLIMIT_AS, &less);
  const std::string error = gltfError(text);
  setrlimit(RLIMIT_AS, &before);
  expectMessage(error, {"mesh.gltf needs about", "GB of memory"});
}

TEST(Gltf, ManyMaterialsAreFoundByTheirNumbers) {
  // Searched one by one they take longer than ctest waits.
  constexpr std::size_t kMaterials = 240000;
  GltfText text = quadText();
  const Json primitive = text.primitive();
  for (std::size_t i = 0; i < kMaterials; ++i) {
    text.json["materials"].push_back({{"name", std::to_string(i)}});
    text.json["meshes"][0]["primitives"][i] = primitive;
    text.json["meshes"][0]["primitives"][i]["material"] = kMaterials - 1 - i;
  }
  const PartMesh mesh = gltf(text);
  ASSERT_EQ(mesh.parts.size(), kMaterials);
  EXPECT_EQ(mesh.mesh.triangle_materials[0], kMaterials - 1);
}

}  // namespace
}  // namespace glintmark
