// What a command reads is not written over, whatever named it: a mesh's buffer, a map's layer.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

// A triangle whose corners lie in a file of any name.
void writeTriangle(const fs::path& gltf, const fs::path& corners) {
  const float values[9] = {-1, 0, -1, 1, 0, -1, 0, 0, 1};
  writeFile(corners, {reinterpret_cast<const char*>(values), sizeof values});
  writeFile(gltf,
            R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
               "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                              "min": [-1, 0, -1], "max": [1, 0, 1]}],
               "bufferViews": [{"buffer": 0, "byteLength": 36}],
               "buffers": [{"byteLength": 36, "uri": ")" +
                corners.lexically_relative(gltf.parent_path()).string() + "\"}]}");
}

void expectKept(const fs::path& input, const std::vector<std::string>& words) {
  const std::string before = readFile(input);
  const ProcessResult result = runGlintmark(words);
  EXPECT_EQ(result.exit_code, 2) << words[0] << ": " << result.out;
  EXPECT_NE(result.err.find("'" + input.string() + "' would be written over what is read"),
            std::string::npos)
      << words[0] << ": " << result.err;
  EXPECT_EQ(readFile(input), before) << words[0];
}

TEST(OwnFiles, AreNoneThatAMeshFileNames) {
  const TempFolder folder;
  const fs::path mesh = folder / "mesh.gltf";
  for (const auto& [corners, words] : std::vector<std::pair<fs::path, std::vector<std::string>>>{
           {"a.png", {"render", "screen_plane", "-o"}},
           {"a.exr", {"render", "screen_plane", "-o", folder / "b.png", "--aov"}},
           {"a.trace", {"render", "screen_plane", "-o", folder / "b.png", "--trace"}},
           {"a.png", {"heatmap", "screen_plane", "-o"}},
           {"a.csv", {"heatmap", "--sweep-angle", "--csv"}},
           {"a.table", {"fit", "gmm", "--scene", "disk", "-o"}}}) {
    const fs::path input = folder / corners.string();
    writeTriangle(mesh, input);
    std::vector<std::string> whole = {"--mesh", mesh};
    whole.insert(whole.end(), words.begin(), words.end());
    whole.push_back(input);
    expectKept(input, whole);
  }
}

TEST(OwnFiles, OfAResultsFolderAreNoneThatAMeshFileNames) {
  const TempFolder folder;
  const fs::path mesh = folder / "mesh.gltf", results = folder / "results";
  fs::create_directory(results);
  for (const char* name : {"results.json", "results.csv", "table.txt"}) {
    writeTriangle(mesh, results / name);
    expectKept(results / name, {"bench", "zk16", "--scene", "screen_plane", "--size", "64x36",
                                "--reps", "1", "--mesh", mesh, "-o", results});
    fs::remove(results / name);
  }
  for (const char* name : {"scene.xml", "README.md"}) {
    writeTriangle(mesh, results / name);
    expectKept(results / name,
               {"export", "screen_plane", "--size", "64x36", "--mesh", mesh, "-o", results});
    fs::remove(results / name);
  }
}

TEST(OwnFiles, AreNoneOfWhichALayerIsRead) {
  const TempFolder folder;
  const fs::path sky = folder / "sky.exr";
  writeExr(Image(8, 8, 3), sky);
  expectKept(sky, {"render", "screen_plane", "-o", sky, "--set",
                   "environment.image='" + sky.string() + "#'"});
}

TEST(OwnFiles, AreNoneOfTheProgramsOwn) {
  const fs::path kernel = fs::path(GLINTMARK_SOURCE_DIR) / "kernels" / "shade.cl";
  expectKept(kernel, {"bench", "zk16", "--scene", "screen_plane", "--size", "64x36", "--reps", "1",
                      "--json", kernel, "-o", TempFolder() / "results"});
}

// Results beside the meshes that are looked for are written again and again.
TEST(OwnFiles, MayLieAmongAssets) {
  const TempFolder folder;
  for (int run = 0; run < 2; ++run) {
    const ProcessResult result =
        runGlintmark({"bench", "zk16", "--scene", "screen_plane", "--view", "steep", "--size",
                      "64x36", "--reps", "1", "--assets", folder.path(), "-o", folder.path()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
}

}  // namespace
}  // namespace glintmark
