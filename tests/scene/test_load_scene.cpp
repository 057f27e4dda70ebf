#include <gtest/gtest.h>

#include "host/scene/load_scene.h"

namespace glintmark {
namespace {

TEST(LoadScene, ScreenPlane) {
  const Scene scene =
      loadScene({.scene = "screen_plane", .overrides = {}, .mesh_file = {}, .asset_folder = {}});
  EXPECT_EQ(scene.mesh.triangleCount(), 2u);
  EXPECT_EQ(scene.views.size(), 3u);
}

}  // namespace
}  // namespace glintmark
