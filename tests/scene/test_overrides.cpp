// `--set path=value` acts before the file is read, so everything it sets is checked as usual.
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

TEST(Overrides, SetValuesByNameAndPosition) {
  const Scene scene =
      load("sand", {"material.sand.size_variation=7", "material.0.intensity=0.5",
                    "light.sun.half_angle_deg=30", "light.1.irradiance=[1, 2, 3]",
                    "post.exposure=2", "mesh.columns=4", "view.front.orbit.angle_deg=45"});
  EXPECT_EQ(scene.materials[0].params.glints.size_variation, 7);
  EXPECT_EQ(scene.materials[0].params.surface.intensity, 0.5f);
  EXPECT_NEAR(scene.lights[0].direction.w, glm::radians(30.0), 1e-6);
  EXPECT_EQ(scene.lights[1].irradiance.z, 3);
  EXPECT_EQ(scene.post.exposure, 2);
  EXPECT_EQ(scene.mesh.triangleCount(), 4u * 400 * 2);
  EXPECT_EQ(scene.view("front").orbit->angle_deg, 45);
}

TEST(Overrides, LaterOnesWin) {
  const Scene scene = load("screen_plane", {"post.exposure=2", "post.exposure=3"});
  EXPECT_EQ(scene.post.exposure, 3);
}

TEST(Overrides, CreateMissingTablesAndElements) {
  const TemporaryFolder folder;
  const Scene scene =
      load(folder.write("scene.toml",
                        sceneText("generator = \"plane\"", "palette = [[1, 0, 0], [0, 1, 0]]")),
           {"post.star=true", "material.paint.palette.1=[0, 0, 1]"});
  EXPECT_TRUE(scene.post.star);
  EXPECT_EQ(scene.materials[0].params.glints.palette[1].z, 1);
  EXPECT_EQ(scene.materials[0].params.glints.palette[0].x, 1);
}

TEST(Overrides, BareWordsAreStrings) {
  const Scene scene = load("screen_plane", {"material.glitter.type=smooth"});
  EXPECT_FALSE(scene.materials[0].has_glints);
  // Neither quotes nor line breaks reach the TOML parser as such.
  expectMessage(errorOf([] { load("screen_plane", {"material.glitter.type=a\"b\\c"}); }),
                {"is 'a\"b\\c', expected glints"});
  const std::string message =
      errorOf([] { load("screen_plane", {"material.glitter.log_density=1\nx = 2"}); });
  EXPECT_NE(message.find("expected a number"), std::string::npos) << message;
}

TEST(Overrides, UnknownPathsListWhatIsKnown) {
  expectMessage(errorOf([] { load("snow", {"material.ice.f0=1"}); }),
                {"--set material.ice.f0=1: material has no element ice, known are snow"});
  expectMessage(errorOf([] { load("sand", {"light.2.irradiance=1"}); }),
                {"light has no element 2, known are sun, sky"});
  expectMessage(errorOf([] { load("snow", {"material.snow.colour=1"}); }),
                {"--set material.snow.colour=1: material.snow.colour is an unknown key", "albedo"});
  expectMessage(errorOf([] { load("snow", {"description.x=1"}); }),
                {"description is a plain value and has no key x"});
  expectMessage(errorOf([] { load("snow", {"description.x.y=1"}); }),
                {"description is a plain value and has no key x"});
  expectMessage(errorOf([] { load("snow", {"pst.star=true"}); }),
                {"pst is an unknown key", "post"});
}

TEST(Overrides, MalformedOnes) {
  expectMessage(errorOf([] { load("snow", {"material.snow.f0"}); }), {"expected key.key=value"});
  expectMessage(errorOf([] { load("snow", {"=1"}); }), {"expected key.key=value"});
  expectMessage(errorOf([] { load("snow", {"material..f0=1"}); }), {"the path has an empty step"});
}

TEST(Overrides, ValuesAreCheckedAndBlamedOnTheCommandLine) {
  expectMessage(errorOf([] { load("snow", {"material.snow.size_variation=-1"}); }),
                {"--set material.snow.size_variation=-1: material.snow.size_variation is -1"});
  expectMessage(errorOf([] { load("snow", {"view.steep=3"}); }), {"view holds 3, expected tables"});
}

}  // namespace
}  // namespace glintmark
