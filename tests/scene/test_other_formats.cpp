// Formats that assimp reads, in a process of its own.

#include "host/scene/import/read_other.h"
#include "host/scene/import_mesh.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

TEST(OtherFormats, PartsAndTrianglesComeOverWhole) {
  const TemporaryFolder folder;
  const PartMesh mesh = importMesh(folder.write(
      "mesh.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2 3\n3 0 1 4\n"));
  EXPECT_EQ(mesh.mesh.triangleCount(), 3u);
  EXPECT_EQ(mesh.parts.size(), 1u);
  EXPECT_EQ(mesh.mesh.positions[0], glm::vec3(0));
}

// Colours of this format make assimp 5.2 crash; one that reads them is as good.
TEST(OtherFormats, WhatMakesAssimpCrashIsASentence) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("mesh.raw", "one\n0.5 0.5 0.5 0 0 0 1 0 0 0 1 0\n0.1 0 0 0 0 3 0 1 3 1 0 3\n");
  try {
    EXPECT_EQ(importMesh(file).mesh.triangleCount(), 2u);
  } catch (const Error& error) {
    expectMessage(error.what(), {"mesh.raw: cannot be read as a mesh: assimp, which reads such "
                                 "files, was ended by signal"});
  }
}

TEST(OtherFormats, WhatAssimpIsNotDoneWithIsASentence) {
  const TemporaryFolder folder;
  std::string text = "OFF\n300000 1 0\n";
  for (int i = 0; i < 300000; ++i) text += "0.125 0.25 0.375\n";
  const std::string file = folder.write("mesh.off", text + "3 0 1 2\n");
  expectMessage(errorOf([&] { readOther(file, {.cpu_s = 0.001}); }),
                {"mesh.off", "assimp", "was not done after"});
}

TEST(OtherFormats, WhatNoReaderKnowsIsNamedByItsEnding) {
  const TemporaryFolder folder;
  for (const char* name : {"mesh.usda", "mesh.step2"})
    expectMessage(errorOf([&] { importMesh(folder.write(name, "#usda 1.0\n")); }),
                  {name, "of no mesh format"});
  expectMessage(errorOf([&] { importMesh(folder.write("mesh", "#usda 1.0\n")); }),
                {"without an extension"});
}

}  // namespace
}  // namespace glintmark
