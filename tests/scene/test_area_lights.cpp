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

TEST(AreaLights, DiscsSpheresAndTubes) {
  const TemporaryFolder folder;
  const auto lightOf = [&](const std::string& keys) {
    const std::string text =
        "[mesh]\ngenerator = 'plane'\n[[material]]\nname = 'm'\ntype = 'smooth'\n"
        "[[view]]\nname = 'v'\n[[area_light]]\n";
    return load(folder.write("scene.toml", text + keys + "\n")).area_lights.at(0);
  };
  AreaLight light = lightOf("shape = 'disc'\ncentre = [1, 2, 3]\nnormal = [0, 0, 2]\nradius = 0.5");
  EXPECT_EQ(light.shape, LightShape::kDisc);
  EXPECT_EQ(light.centre, glm::dvec3(1, 2, 3));
  EXPECT_EQ(areaLightNormal(light), glm::dvec3(0, 0, 1));
  EXPECT_NEAR(areaLightArea(light), M_PI / 4, 1e-12);
  light = lightOf("shape = 'sphere'\nradius = 2\ntwo_sided = true");
  EXPECT_EQ(light.shape, LightShape::kSphere);
  EXPECT_NEAR(areaLightArea(light), 16 * M_PI, 1e-12);
  EXPECT_TRUE(light.two_sided);
  light = lightOf("shape = 'tube'\nends = [[0, 1, 0], [3, 1, 0]]\nradius = 0.5");
  EXPECT_EQ(light.shape, LightShape::kTube);
  EXPECT_EQ(light.centre + light.axis, glm::dvec3(3, 1, 0));
  EXPECT_NEAR(areaLightArea(light), 2 * M_PI * 0.5 * 3 + 2 * M_PI * 0.25, 1e-12);
  light = lightOf(std::string("shape = 'polygon'\n") + kSquare);
  EXPECT_EQ(light.shape, LightShape::kPolygon);
}

TEST(AreaLights, RadiiAreAcrossTheAxis) {
  for (const glm::dvec3& axis :
       {glm::dvec3(0, 0, 3), glm::dvec3(1, 0, 0), glm::dvec3(1, -2, 0.5)}) {
    const auto radii = lightRadii(axis, 2);
    EXPECT_NEAR(glm::length(radii[0]), 2, 1e-12);
    EXPECT_NEAR(glm::dot(radii[0], radii[1]), 0, 1e-12);
    EXPECT_LT(glm::distance(glm::cross(radii[0], radii[1]), 4.0 * glm::normalize(axis)), 1e-12);
  }
}

TEST(AreaLights, BadDiscsSpheresAndTubes) {
  expectMessage(lightComplaint("shape = 'cube'\nradius = 1"),
                {"area_light.lamp.shape is 'cube', expected polygon, disc, sphere, tube"});
  expectMessage(lightComplaint("shape = 'disc'"), {"area_light.lamp.radius is missing"});
  expectMessage(lightComplaint("shape = 'sphere'\nradius = 0"), {"radius is 0"});
  expectMessage(lightComplaint("shape = 'sphere'\nradius = nan"), {"radius is nan"});
  expectMessage(lightComplaint("shape = 'disc'\nradius = 1\nnormal = 0"), {"normal is 0"});
  expectMessage(lightComplaint("shape = 'tube'\nradius = 1"), {"area_light.lamp.ends is missing"});
  expectMessage(lightComplaint("shape = 'tube'\nradius = 1\nends = [[0, 0, 0]]"),
                {"ends has 1 points, expected the 2 ends of the tube"});
  expectMessage(lightComplaint("shape = 'tube'\nradius = 1\nends = [[1, 0, 0], [1, 0, 0]]"),
                {"ends are in the same place"});
  expectMessage(lightComplaint(std::string("shape = 'disc'\nradius = 1\n") + kSquare),
                {"vertices comes with the shape 'disc', expected one way or the other"});
  expectMessage(lightComplaint("shape = 'disc'\nradius = 1\ntexture = 'panes'"),
                {"texture comes with the shape 'disc'", "parallelogram"});
  // A sphere has no ends, a polygon no radius.
  expectMessage(lightComplaint("shape = 'sphere'\nradius = 1\nends = [[0, 0, 0], [1, 0, 0]]"),
                {"ends"});
  expectMessage(lightComplaint(std::string(kSquare) + "\nradius = 1"), {"radius"});
}

TEST(AreaLights, GlintsWantPolygons) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("scene.toml",
                   "[mesh]\ngenerator = 'plane'\n[[material]]\nname = 'snow'\ntype = 'glints'\n"
                   "[[view]]\nname = 'v'\n[[area_light]]\nname = 'lamp'\nshape = 'sphere'\n"
                   "radius = 1\n");
  expectMessage(errorOf([&] { load(file); }), {"'lamp'", "'snow'", "polygons only"});
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
