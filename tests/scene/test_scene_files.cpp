// Where scenes are found, and what the files in the scene folder hold.
#include <cstdlib>

#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

TEST(SceneFiles, AllScenesAreListedAndLoad) {
  const std::vector<std::string> expected = {
      "area_brushed", "area_cloth", "area_glass",   "area_knot",  "area_plane",
      "area_shapes",  "armour",     "brushed",      "car",        "circular_brushing",
      "desert",       "disk",       "dress",        "glitter",    "hero",
      "knot",         "lit_glints", "mixed",        "rough_knot", "rough_metal",
      "rough_plane",  "sand",       "screen_plane", "snow",       "sponza"};
  EXPECT_EQ(listScenes(), expected);
  for (const std::string& name : expected) {
    const Scene scene = load(name);
    EXPECT_EQ(scene.name, name);
    EXPECT_FALSE(scene.description.empty()) << name;
    EXPECT_FALSE(scene.views.empty()) << name;
    EXPECT_FALSE(scene.lights.empty() && scene.area_lights.empty()) << name;
    for (const std::string& note : scene.notes)
      EXPECT_NE(note.find("has an intensity of"), std::string::npos) << name << ": " << note;
  }
}

TEST(SceneFiles, FolderFromTheEnvironment) {
  const TemporaryFolder folder;
  folder.write("only.toml", sceneText());
  ASSERT_EQ(setenv("GLINTMARK_SCENES", folder.path().c_str(), 1), 0);
  EXPECT_EQ(sceneFolder(), folder.path());
  EXPECT_EQ(listScenes(), std::vector<std::string>{"only"});
  EXPECT_EQ(load("only").mesh.triangleCount(), 2u);
  unsetenv("GLINTMARK_SCENES");
}

// [ZK16] Sect. 4.5: micro roughness is relative to global roughness, density is a logarithm.
TEST(SceneFiles, MaterialParameters) {
  const TemporaryFolder folder;
  const Scene scene = load(folder.write(
      "scene.toml", sceneText("generator = 'plane'",
                              "global_roughness = [0.2, 0.4]\nmicro_roughness = [0.5, 0.25]\n"
                              "log_density = 3\ntype = 'grooves'\npalette = 'wheel'\nf0 = 0.5")));
  const Material& material = scene.materials[0];
  EXPECT_FLOAT_EQ(material.params.surface.alpha_g.x, 0.2f);
  EXPECT_FLOAT_EQ(material.params.glints.alpha_l.x, 0.1f);
  EXPECT_FLOAT_EQ(material.params.glints.alpha_l.y, 0.1f);
  EXPECT_FLOAT_EQ(material.params.glints.density, 1000);
  EXPECT_FLOAT_EQ(material.params.surface.f0.y, 0.5f);
  EXPECT_TRUE(material.has_glints && material.has_grooves && material.has_colour);
  EXPECT_EQ(material.params.glints.palette_count, 0u);
}

TEST(SceneFiles, PlaneHasThePaperlikeMaterial) {
  const Scene scene = load("screen_plane");
  EXPECT_FLOAT_EQ(scene.materials[0].params.surface.alpha_g.x, 0.3f);
  EXPECT_FLOAT_EQ(scene.materials[0].params.glints.alpha_l.x, 0.03f);
  EXPECT_FLOAT_EQ(scene.materials[0].params.glints.density, 1e6f);
}

TEST(SceneFiles, LightsFromAngles) {
  const TemporaryFolder folder;
  const Scene scene = load(
      folder.write("scene.toml", sceneText() + "[[light]]\nazimuth_deg = 90\nelevation_deg = 30\n"
                                               "[[light]]\ndirection = [0, 0, 5]\n"));
  EXPECT_NEAR(scene.lights[1].direction.x, std::sqrt(0.75), 1e-6);
  EXPECT_NEAR(scene.lights[1].direction.y, 0.5, 1e-6);
  EXPECT_NEAR(scene.lights[1].direction.z, 0, 1e-6);
  EXPECT_NEAR(scene.lights[2].direction.z, 1, 1e-6);
}

TEST(SceneFiles, ImageLoaderIsAskedForTheFile) {
  const TemporaryFolder folder;
  folder.write("sky.hdr", "");
  SceneRequest request;
  request.scene =
      folder.write("scene.toml", sceneText() + "[environment]\nimage = 'sky.hdr'\ncones = 4\n");
  std::filesystem::path asked;
  request.image_loader = [&](const std::filesystem::path& file) {
    asked = file;
    Image image(8, 4, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), 1.0f);
    return image;
  };
  const Scene scene = loadScene(request);
  EXPECT_EQ(asked, folder.path() / "sky.hdr");
  EXPECT_TRUE(scene.environment.present);
  EXPECT_EQ(scene.environment.cone_count, 4);
  EXPECT_EQ(scene.lights.size(), 5u);  // the sun first
}

}  // namespace
}  // namespace glintmark
