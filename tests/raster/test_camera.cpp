// The pixel grid's rays, and what makeCamera refuses.
#include <gtest/gtest.h>

#include <limits>

#include "host/core/error.h"
#include "tests/raster/test_meshes.h"

namespace glintmark::test {
namespace {

// A few rounding errors of unit-sized numbers.
constexpr double kRounding = 1e-14;

TEST(Camera, CentreRayIsTheViewAxis) {
  const Camera camera = makeCamera(lookAt({1, 2, 3}, {4, -1, 0}), 641, 481);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(3, -3, -3));
  EXPECT_LT(glm::length(camera.ray(320, 240) - axis), kRounding);
  EXPECT_LT(glm::length(camera.forward - axis), kRounding);
}

TEST(Camera, AxesAreOrthonormalAndRightHanded) {
  const Camera c = makeCamera(lookAt({1, 2, 3}, {4, -1, 0}), 640, 480);
  EXPECT_LT(glm::length(glm::cross(c.right, c.up) + c.forward), kRounding);
  EXPECT_NEAR(glm::length(c.right), 1, kRounding);
  EXPECT_NEAR(glm::dot(c.right, c.up), 0, kRounding);
  EXPECT_GT(c.up.y, 0);
}

TEST(Camera, EveryRayHasUnitDepth) {
  const Camera c = makeCamera(lookAt({0, 5, 0}, {1, 0, 2}), 100, 50);
  for (const auto& [x, y] : {std::pair{0, 0}, {99, 0}, {0, 49}, {99, 49}})
    EXPECT_NEAR(glm::dot(c.ray(x, y), c.forward), 1, kRounding);
}

TEST(Camera, FieldOfViewSpansTheHeight) {
  const Camera c = makeCamera(lookAt({0, 0, 0}, {0, 0, -1}, 90), 200, 100);
  // The image's upper border is half a pixel above row 0.
  EXPECT_NEAR(glm::dot(c.ray(0, -0.5), c.up), 1, kRounding);
  EXPECT_NEAR(glm::dot(c.ray(-0.5, 0), c.right), -2, 2 * kRounding);
}

TEST(Camera, RefusesBadSizes) {
  const View view = lookAt({0, 0, 1}, {0, 0, 0});
  for (const auto& [w, h] :
       {std::pair{0, 10}, {10, 0}, {-1, 10}, {16385, 1}, {1, 1000000}, {16384, 16385}})
    EXPECT_THROW(makeCamera(view, w, h), Error) << w << "x" << h;
  EXPECT_NO_THROW(makeCamera(view, 16384, 16384));
  EXPECT_NO_THROW(makeCamera(view, 1, 1));
}

TEST(Camera, RefusesBadViews) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const View good = lookAt({0, 0, 1}, {0, 0, 0});
  const auto refused = [](const View& view) { EXPECT_THROW(makeCamera(view, 64, 64), Error); };
  View view = good;
  view.target = view.eye;
  refused(view);
  view = good;
  view.up = {0, 0, 2};
  refused(view);
  view.up = {0, 0, 0};
  refused(view);
  view = good;
  view.eye.x = nan;
  refused(view);
  for (const double fov : {0.0, 180.0, -1.0, nan}) {
    view = good;
    view.fov_y_deg = fov;
    refused(view);
  }
  for (const double near_plane : {0.0, -1.0, nan, double(INFINITY)}) {
    view = good;
    view.near_plane = near_plane;
    refused(view);
  }
}

}  // namespace
}  // namespace glintmark::test
