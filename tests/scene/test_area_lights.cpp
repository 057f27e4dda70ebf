// [[area_light]]: what it reads and what it refuses.
#include <cmath>

#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

std::string withLight(const std::string& keys) {
  return sceneText() + "[[area_light]]\nname = \"lamp\"\n" + keys + "\n";
}

constexpr const char* kSquare = "vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]";

std::string lightComplaint(const std::string& keys) {
  const TemporaryFolder folder;
  const std::string file = folder.write("scene.toml", withLight(keys));
  return errorOf([&] { load(file); });
}

TEST(AreaLights, VerticesAndRectangles) {
  const TemporaryFolder folder;
  Scene scene = load(folder.write("a.toml", withLight(std::string(kSquare) + "\nradiance = 2")));
  ASSERT_EQ(scene.area_lights.size(), 1u);
  EXPECT_EQ(areaLightNormal(scene.area_lights[0]), glm::dvec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(areaLightArea(scene.area_lights[0]), 1);
  EXPECT_EQ(scene.area_lights[0].radiance, glm::dvec3(2));
  scene = load(folder.write(
      "b.toml", withLight("rectangle = { centre = [0, 2, 0], normal = [0, -1, 0], size = [2, 3] }\n"
                          "two_sided = true\ntexture = \"panes\"")));
  EXPECT_LT(glm::distance(areaLightNormal(scene.area_lights[0]), glm::dvec3(0, -1, 0)), 1e-12);
  EXPECT_NEAR(areaLightArea(scene.area_lights[0]), 6, 1e-12);
  EXPECT_TRUE(scene.area_lights[0].two_sided);
  EXPECT_EQ(scene.area_lights[0].texture.channels, 3);
}

TEST(AreaLights, OneIsEnoughLightForAScene) {
  const TemporaryFolder folder;
  const std::string text =
      "[mesh]\ngenerator = 'plane'\n[[material]]\nname = 'm'\n"
      "[[view]]\nname = 'v'\n[[area_light]]\n";
  EXPECT_TRUE(load(folder.write("scene.toml", text + kSquare)).lights.empty());
}

TEST(AreaLights, BadShapes) {
  expectMessage(lightComplaint("vertices = [[0, 0, 0], [1, 0, 0]]"),
                {"area_light.lamp.vertices has 2 vertices, expected 3 to 8"});
  expectMessage(
      lightComplaint("vertices = [[0,0,0],[1,0,0],[2,1,0],[2,2,0],[2,3,0],[1,4,0],[0,4,0],"
                     "[-1,3,0],[-1,1,0]]"),
      {"has 9 vertices"});
  expectMessage(lightComplaint("vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0.2], [0, 1, 0]]"),
                {"is not flat", "vertex 3"});
  expectMessage(lightComplaint("vertices = [[0, 0, 0], [1, 0, 0], [0.2, 0.2, 0], [0, 1, 0]]"),
                {"is not convex"});
  expectMessage(lightComplaint("vertices = [[0, 0, 0], [1, 0, 0], [nan, 1, 0]]"),
                {"area_light.lamp.vertices is nan", "finite"});
  expectMessage(lightComplaint("vertices = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]"),
                {"encloses no area"});
  expectMessage(lightComplaint("vertices = [[0, 0, 0], [0, 0, 0], [1, 1, 0]]"),
                {"vertices 0 and 1 in the same place"});
  expectMessage(lightComplaint(""), {"vertices is missing", "rectangle"});
}

TEST(AreaLights, StarsAreNotConvex) {
  AreaLight star;
  for (int i = 0; i < 5; ++i)
    star.vertices.push_back({std::cos(i * 4 * M_PI / 5), std::sin(i * 4 * M_PI / 5), 0});
  EXPECT_NE(areaLightComplaint(star).find("not convex"), std::string::npos);
}

TEST(AreaLights, BadValues) {
  const std::string square = std::string(kSquare) + "\n";
  expectMessage(lightComplaint(square + "radiance = -1"), {"radiance is -1"});
  expectMessage(lightComplaint(square + "texture = 'plaid'"), {"texture is 'plaid'", "checker"});
  expectMessage(lightComplaint(square + "image = 'nowhere.png'"), {"nowhere.png"});
  expectMessage(lightComplaint(square + "rectangle = { size = 1 }"), {"one way or the other"});
  expectMessage(lightComplaint("rectangle = { normal = 0 }"), {"normal is 0"});
  expectMessage(lightComplaint("rectangle = { size = 0 }"), {"size is 0"});
  expectMessage(lightComplaint("rectangle = { normal = [0, 0, 1], up = [0, 0, 2] }"), {"parallel"});
  expectMessage(lightComplaint("vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntexture = 'panes'"),
                {"no parallelogram"});
}

}  // namespace
}  // namespace glintmark
