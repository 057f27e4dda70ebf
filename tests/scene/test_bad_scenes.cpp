// Every mistake in a scene file gets one sentence that names the place and what would be right.

#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

/// Loads a scene file of this text and returns the complaint.
std::string complaint(const TemporaryFolder& folder, const std::string& text) {
  const std::string file = folder.write("scene.toml", text);
  return errorOf([&] { load(file); });
}

TEST(BadScenes, TheBaseSceneLoads) {
  const TemporaryFolder folder;
  const Scene scene = load(folder.write("scene.toml", sceneText()));
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.mesh.triangleCount(), 2u);
}

TEST(BadScenes, MissingScene) {
  expectMessage(errorOf([] { load("snowman"); }),
                {"unknown scene 'snowman'; scenes in", "snow", "car"});
  expectMessage(errorOf([] { load(""); }), {"scenes in"});
  expectMessage(errorOf([] { load("../scenes/snow"); }), {"scenes in"});
  expectMessage(errorOf([] { load("nowhere/x.toml"); }), {"nowhere/x.toml"});
}

TEST(BadScenes, MalformedToml) {
  const TemporaryFolder folder;
  expectMessage(complaint(folder, "[mesh]\ngenerator = \"plane\nsize = 1\n"),
                {"scene.toml:2: malformed TOML"});
  expectMessage(complaint(folder, "a = 1\na = 2\n"), {"scene.toml:2: malformed TOML"});
}

TEST(BadScenes, UnknownKeys) {
  const TemporaryFolder folder;
  expectMessage(complaint(folder, sceneText("generator = \"plane\"\nsise = 2")),
                {"scene.toml:3: mesh.sise is an unknown key, known here are", "size"});
  expectMessage(complaint(folder, sceneText("generator = \"plane\"", "colour = 1")),
                {"scene.toml:5: material.paint.colour", "global_roughness"});
  expectMessage(complaint(folder, "lights = 1\n" + sceneText()), {"scene.toml:1: lights", "light"});
  expectMessage(complaint(folder, sceneText("generator = \"plane\"", "", "zoom = 1")),
                {"view.front.zoom", "fov_y_deg"});
  expectMessage(complaint(folder, sceneText() + "[post]\nglow = true"), {"post.glow", "exposure"});
  expectMessage(complaint(folder, sceneText() + "[environment]\nmap = 'x'"), {"environment.map"});
}

TEST(BadScenes, UnknownGenerator) {
  const TemporaryFolder folder;
  expectMessage(complaint(folder, sceneText("generator = \"teapot\"")),
                {"scene.toml:2: mesh.generator is 'teapot', known are arcade, car"});
}

TEST(BadScenes, MissingSections) {
  const TemporaryFolder folder;
  const std::string material = "[[material]]\nname = 'm'\n", view = "[[view]]\nname = 'v'\n";
  const std::string light = "[[light]]\n", mesh = "[mesh]\ngenerator = 'plane'\n";
  expectMessage(complaint(folder, material + view + light), {"mesh is missing"});
  expectMessage(complaint(folder, mesh + view + light), {"material is missing"});
  expectMessage(complaint(folder, mesh + material + light), {"view is missing"});
  expectMessage(complaint(folder, mesh + material + view), {"light is missing"});
  expectMessage(complaint(folder, "[mesh]\n" + material + view + light),
                {"mesh.generator is missing"});
  expectMessage(complaint(folder, mesh + "[[material]]\n" + view + light), {"material.0.name"});
}

TEST(BadScenes, DuplicateNames) {
  const TemporaryFolder folder;
  expectMessage(complaint(folder, sceneText() + "[[view]]\nname = 'front'"),
                {"view.front.name is taken by another view"});
  expectMessage(complaint(folder, sceneText() + "[[material]]\nname = 'paint'"),
                {"material.paint.name is taken by another material"});
}

struct BadValue {
  const char* line;      // of the material
  const char* expected;  // in the message
};

void PrintTo(const BadValue& value, std::ostream* out) {
  *out << value.line;
}

class BadMaterialValues : public testing::TestWithParam<BadValue> {};

TEST_P(BadMaterialValues, AreErrors) {
  const TemporaryFolder folder;
  expectMessage(complaint(folder, sceneText("generator = \"plane\"", GetParam().line)),
                {"scene.toml:5: material.paint.", GetParam().expected});
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMaterialValues,
    testing::Values(
        BadValue{"global_roughness = 0", "is 0, expected a number in [1e-06, 1]"},
        BadValue{"global_roughness = 1e-7", "is 1e-07, expected a number in [1e-06, 1]"},
        BadValue{"global_roughness = 1.5", "expected a number in [1e-06, 1]"},
        BadValue{"global_roughness = nan", "is nan, expected a number in [1e-06, 1]"},
        BadValue{"global_roughness = [0.1, 0.2, 0.3]", "expected 2 numbers or one"},
        BadValue{"global_roughness = \"rough\"", "is 'rough', expected 2 numbers or one"},
        BadValue{"micro_roughness = [0.5, -0.1]", "is -0.1, expected a number in [1e-06, 1]"},
        BadValue{"micro_roughness = 1.01", "expected a number in [1e-06, 1]"},
        BadValue{"log_density = 40", "is 40, expected a number in [-12, 18]"},
        BadValue{"log_density = true", "expected a number in"},
        BadValue{"size_variation = -1", "is -1, expected a number of at least 0"},
        BadValue{"intensity = inf", "expected a number of at least 0"},
        BadValue{"f0 = [1.0, 2.0, 0.0]", "expected a number in [0, 1]"},
        BadValue{"albedo = [0.1, 0.2]", "expected 3 numbers or one"},
        BadValue{"type = \"glitter\"", "expected glints, grooves or smooth"},
        BadValue{"diffuse_model = \"oren\"", "expected lambert, published, refit, eon or fitted"},
        BadValue{"diffuse_masking = 0.5", "needs diffuse_model published or refit"},
        BadValue{"diffuse_masking = 2", "expected a number in [0, 1]"},
        BadValue{"compensation = \"full\"",
                 "is 'full', expected off, lobe, simulated, mean, kulla_conty or fdez_aguera"},
        BadValue{"compensation = \"kulla_conty\"\nalbedo = 0.5", "it needs albedo 0"},
        BadValue{"compensation = \"simulated\"\nndf = \"ggx\"", "is of Beckmann's facets"},
        BadValue{"palette = \"rainbow\"", "expected \"wheel\" or a list"},
        BadValue{"palette = []", "has 0 colours, expected 1 to 8"},
        BadValue{"palette = 3", "expected a list of colours"}));

TEST(BadScenes, LightValues) {
  const TemporaryFolder folder;
  const auto with_light = [&](const std::string& lines) {
    return complaint(folder, sceneText() + "[[light]]\nname = 'l'\n" + lines);
  };
  expectMessage(with_light("half_angle_deg = 91"), {"light.l.half_angle_deg", "[0, 90]"});
  expectMessage(with_light("irradiance = -1"), {"light.l.irradiance is -1", "at least 0"});
  expectMessage(with_light("direction = [0, 0, 0]"), {"light.l.direction is 0"});
  expectMessage(with_light("direction = [0, 1, 0]\nazimuth_deg = 3"), {"one way or the other"});
}

TEST(BadScenes, ViewValues) {
  const TemporaryFolder folder;
  const auto with_view = [&](const std::string& lines) {
    return complaint(folder, sceneText() + "[[view]]\nname = 'v'\n" + lines);
  };
  expectMessage(with_view("fov_y_deg = 180"), {"view.v.fov_y_deg is 180"});
  expectMessage(with_view("near_plane = 0"), {"view.v.near_plane is 0, expected a number above 0"});
  expectMessage(with_view("eye = [1, 1, 1]\ntarget = [1, 1, 1]"), {"view.v.eye is the target"});
  expectMessage(with_view("eye = [0, 5, 0]"), {"view.v.up is along the view axis"});
  expectMessage(with_view("orbit = { angle_deg = 0 }"), {"view.v.orbit.angle_deg is 0", "(0, 90]"});
  expectMessage(with_view("orbit = { distance = 0 }"), {"view.v.orbit.distance is 0"});
  expectMessage(with_view("orbit = { normal = 0 }"), {"view.v.orbit.normal is 0"});
  expectMessage(with_view("orbit = { angle = 5 }"), {"view.v.orbit.angle is an unknown key"});
  expectMessage(with_view("eye = [1, 1, 1]\norbit = { }"), {"comes with an orbit"});
}

TEST(BadScenes, UnknownView) {
  const TemporaryFolder folder;
  const Scene scene = load(folder.write("scene.toml", sceneText()));
  EXPECT_EQ(scene.view("front").name, "front");
  expectMessage(errorOf([&] { scene.view("back"); }),
                {"unknown view 'back'; views of scene scene are front"});
}

TEST(BadScenes, PartsOfUnknownMaterials) {
  const TemporaryFolder folder;
  expectMessage(complaint(folder, sceneText("generator = 'plane'\nparts = { plane = 'gold' }")),
                {"mesh.parts.plane is 'gold', known materials are paint"});
}

TEST(BadScenes, ImageWithoutALoader) {
  const TemporaryFolder folder;
  folder.write("sky.hdr", "");
  expectMessage(complaint(folder, sceneText() + "[environment]\nimage = 'sky.hdr'"),
                {"environment.image"});
  expectMessage(complaint(folder, sceneText() + "[environment]\nimage = 'none.hdr'"),
                {"no environment image file none.hdr"});
}

TEST(BadScenes, DepthIsBoundedBeforeTheParser) {
  const TemporaryFolder folder;
  const auto repeated = [](const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  for (const int levels : {100, 50000}) {
    expectMessage(complaint(folder, "\n[a" + repeated(".a", levels) + "]\n"),
                  {"scene.toml:2: has a key of more steps than the 64"});
    expectMessage(complaint(folder, "a" + repeated(" . 'a'", levels) + " = 1\n"), {"more steps"});
    expectMessage(complaint(folder, "a = {b" + repeated(".b", levels) + " = 1}\n"), {"more steps"});
    expectMessage(complaint(folder, "a = " + repeated("[", levels) + "\n"), {"more brackets"});
    expectMessage(complaint(folder, "a = " + repeated("{a=", levels) + "\n"), {"more brackets"});
    const std::string scene = folder.write("good.toml", sceneText());
    expectMessage(errorOf([&] { load(scene, {"a" + repeated(".a", levels) + "=1"}); }),
                  {"--set", "64 steps"});
    expectMessage(errorOf([&] { load(scene, {"a=" + repeated("[", levels)}); }), {"more brackets"});
  }
  // Points and brackets in texts, comments and lists of numbers are none.
  const std::string plain =
      "# " + repeated("[.", 200) + "\ndescription = \"\"\"\n" + repeated("[.", 200) +
      "\\\"\"\"\"\n" +
      sceneText("generator = 'plane'\nparts = { 'a" + repeated(".[", 200) + "' = 'paint' }");
  EXPECT_EQ(load(folder.write("plain.toml", plain)).views.size(), 1u);
}

TEST(BadScenes, ManyMaterialsAreFoundByTheirNames) {
  const TemporaryFolder folder;
  std::string text = sceneText(), parts;
  for (int i = 0; i < 100000; ++i) {
    text += "[[material]]\nname = \"m" + std::to_string(i) + "\"\n";
    if (i % 10 == 0) parts += "p" + std::to_string(i) + " = \"m" + std::to_string(i) + "\"\n";
  }
  const std::string file = folder.write("many.toml", text + "[mesh.parts]\n" + parts);
  EXPECT_EQ(load(file).materials.size(), 100001u);
}

TEST(BadScenes, NumbersBeyondFloatsAreRefusedWithTheirKey) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", sceneText());
  for (const char* set :
       {"light.sun.irradiance=1e308", "light.sun.irradiance=[1, 3.5e38, 1]",
        "material.paint.intensity=1e39", "post.exposure=1e300", "view.front.eye=[0, -1e39, 1]"})
    expectMessage(errorOf([&] { load(scene, {set}); }), {set, "range of single precision, 3.4e38"});
  EXPECT_EQ(load(scene, {"light.sun.irradiance=1e38"}).lights.size(), 1u);
  // What has to be above 0 must not become 0 there.
  for (const char* set : {"mesh.uv_scale=1e-300", "post.exposure=1e-39"})
    expectMessage(errorOf([&] { load(scene, {set}); }),
                  {set, "below the range of single precision, 1.2e-38"});
}

// What is asked before maps are made sees their sizes, and nothing is made where it throws.
TEST(BadScenes, MapsAreRefusedBeforeTheyAreMade) {
  const TemporaryFolder folder;
  SceneRequest request;
  std::string text = sceneText();
  request.scene = folder.write("scene.toml", text + R"(
[[material]]
name = "stone"
type = "smooth"
[material.normal_map]
generator = "bumps"
size_px = 16384
[[material]]
name = "brick"
type = "smooth"
[material.normal_map]
file = "brick.png"
)");
  folder.write("brick.png", "");
  int read = 0;
  request.normal_loader = [&](const std::filesystem::path&) {
    ++read;
    return Image(1, 1, 1);
  };
  request.normal_size = [](const std::filesystem::path& file) {
    EXPECT_EQ(file.filename(), "brick.png");
    return glm::ivec2(7000, 9000);
  };
  request.before_maps = [&](const Scene& scene) {
    std::vector<std::string> seen;
    for (const Material& material : scene.materials)
      if (material.normal_map) {
        const NormalMap& map = *material.normal_map->map;
        EXPECT_TRUE(map.normals.empty());
        seen.push_back(map.name + " " + std::to_string(map.width_px) + "x" +
                       std::to_string(map.height_px));
      }
    EXPECT_EQ(seen, (std::vector<std::string>{"bumps 16384x16384", "brick.png 7000x9000"}));
    EXPECT_FALSE(scene.lights.empty() && scene.area_lights.empty());
    throw Error("no room");
  };
  EXPECT_EQ(errorOf([&] { loadScene(request); }), "no room");
  EXPECT_EQ(read, 0);
}

}  // namespace
}  // namespace glintmark
