// Polygon lights that are bent at the horizon instead of clipped to it; clipped ones are checked by
// host/verify.
#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/polygon_cases.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

constexpr int kLanes = 16;

TEST(Polygon, ClippedAndCliplessAgreeAwayFromTheHorizonOnly) {
  AreaLightProbe probe =
      identityProbe(polygonLight(parallelRectangle(0, 0, 3, 0.4, 0.4)), false, kLanes);
  const double above = lightPoints(testBench(), probe, {HandMadePoint{}})[0].x;
  probe.clipless = true;
  EXPECT_NEAR(lightPoints(testBench(), probe, {HandMadePoint{}})[0].x / above, 1, 0.01);
  // Half below and far from round: the form factor of a sphere is off by half and more.
  probe.lights = {polygonLight({{2, -1, -1}, {2, -1, 1}, {2, 1, 1}, {2, 1, -1}}, true)};
  const double bent = lightPoints(testBench(), probe, {HandMadePoint{}})[0].x;
  const double exact = exactFormFactor(probe.lights[0], HandMadePoint{});
  EXPECT_NEAR(bent / exact, 1, 1);
  EXPECT_GT(std::abs(bent / exact - 1), 0.1);
}

}  // namespace
}  // namespace glintmark
