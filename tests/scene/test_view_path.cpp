#include "host/scene/view_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "host/core/error.h"

namespace glintmark {
namespace {

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

View sample() {
  View view;
  view.eye = {0, 0, 2};
  view.target = {0, 0, 0};
  view.up = {0, 3, 0};  // need not be of unit length
  return view;
}

TEST(ViewPath, OrbitTurnsTheEyeAroundTheTarget) {
  const View moved = viewOnPath(sample(), ViewPath::kOrbit, 90);
  expectNear(moved.eye, {2, 0, 0});  // to the right of an eye that looks along -z
  expectNear(moved.target, {0, 0, 0});
  expectNear(viewOnPath(sample(), ViewPath::kOrbit, 360).eye, sample().eye);
}

TEST(ViewPath, DollyComesNearer) {
  expectNear(viewOnPath(sample(), ViewPath::kDolly, 25).eye, {0, 0, 1.5});
  expectNear(viewOnPath(sample(), ViewPath::kDolly, -50).eye, {0, 0, 3});
  EXPECT_THROW(viewOnPath(sample(), ViewPath::kDolly, 100), Error);
}

TEST(ViewPath, PanTurnsTheViewToTheRight) {
  const View moved = viewOnPath(sample(), ViewPath::kPan, 90);
  expectNear(moved.eye, {0, 0, 2});
  expectNear(moved.target, {2, 0, 2});
}

TEST(ViewPath, NamesAreKnown) {
  EXPECT_EQ(parseViewPath("dolly"), ViewPath::kDolly);
  EXPECT_THROW(parseViewPath("crane"), Error);
}

}  // namespace
}  // namespace glintmark
