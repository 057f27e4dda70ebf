#include "host/ocl/kernel_config.h"

#include <set>

#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

TEST(KernelConfig, DefaultsWriteEverySwitch) {
  EXPECT_EQ(buildOptions({}),
            "-D WIDTH=1 -D GLINT=1 -D GROOVE=0 -D GLINT_COLOUR=0 -D SIZE_VARIATION=1 "
            "-D LIGHT_CONE=0 -D DIFFUSE=0 -D COUNT_CELLS=0 -D GLINT_METHOD=0 -D KA=16");
}

TEST(KernelConfig, EverySwitchShows) {
  KernelConfig config;
  config.width = 16;
  config.glint = false;
  config.groove = config.glint_colour = config.light_cone = config.diffuse = config.count_cells =
      true;
  config.size_variation = false;
  config.method = GlintMethod::kExact;
  config.ka = 64;
  EXPECT_EQ(buildOptions(config),
            "-D WIDTH=16 -D GLINT=0 -D GROOVE=1 -D GLINT_COLOUR=1 -D SIZE_VARIATION=0 "
            "-D LIGHT_CONE=1 -D DIFFUSE=1 -D COUNT_CELLS=1 -D GLINT_METHOD=1 -D KA=64");
}

TEST(KernelConfig, PlanesBecomeTheirSlots) {
  KernelConfig config;
  config.planes = {Plane::kDepth, Plane::kPixel, Plane::kDvdx};
  EXPECT_TRUE(buildOptions(config).ends_with(
      " -D KA=16 -D PLANE_PIXEL=0 -D PLANE_DVDX=1 -D PLANE_DEPTH=2"));
  config.planes = PlaneMask::all();
  EXPECT_TRUE(buildOptions(config).ends_with(
      " -D PLANE_PIXEL=0 -D PLANE_U_INT=1 -D PLANE_V_INT=2 -D PLANE_U_FRAC=3 -D PLANE_V_FRAC=4"
      " -D PLANE_DUDX=5 -D PLANE_DVDX=6 -D PLANE_DUDY=7 -D PLANE_DVDY=8 -D PLANE_FRAME0=9"
      " -D PLANE_FRAME1=10 -D PLANE_DEPTH=11"));
}

TEST(KernelConfig, DifferentConfigsGiveDifferentOptions) {
  std::set<std::string> seen;
  for (int bits = 0; bits < 128; ++bits) {
    KernelConfig config;
    config.glint = bits & 1;
    config.groove = bits & 2;
    config.glint_colour = bits & 4;
    config.size_variation = bits & 8;
    config.light_cone = bits & 16;
    config.diffuse = bits & 32;
    config.count_cells = bits & 64;
    seen.insert(buildOptions(config));
  }
  EXPECT_EQ(seen.size(), 128u);
}

TEST(KernelConfig, RangesAreChecked) {
  for (int width : {1, 4, 8, 16}) {
    KernelConfig config;
    config.width = width;
    EXPECT_NO_THROW(buildOptions(config));
  }
  for (int width : {-1, 0, 2, 3, 15, 32}) {
    KernelConfig config;
    config.width = width;
    EXPECT_EQ(errorOf([&] { buildOptions(config); }),
              "kernel width " + std::to_string(width) + " is not one of 1, 4, 8 and 16");
  }
  for (int ka : {-5, 0, 65}) {
    KernelConfig config;
    config.ka = ka;
    EXPECT_EQ(errorOf([&] { buildOptions(config); }),
              "ka " + std::to_string(ka) + " is out of range; it must be 1 to 64");
  }
  KernelConfig config;
  config.method = static_cast<GlintMethod>(2);
  EXPECT_EQ(errorOf([&] { buildOptions(config); }),
            "glint method 2 is unknown; it must be 0 (zk16) or 1 (exact)");
}

}  // namespace
}  // namespace glintmark
