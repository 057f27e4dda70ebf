#include "host/ocl/kernel_config.h"

#include <set>

#include "host/ocl/switches.h"
#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

bool startsWith(const std::string& text, const std::string& start) {
  return text.starts_with(start);
}

// Options key programs on disk and stand in records: whoever adds a switch leaves these as they are
// and comes behind them.
TEST(KernelConfig, DefaultsAreWrittenAsEver) {
  EXPECT_PRED2(
      startsWith, buildOptions({}),
      "-D WIDTH=1 -D ALL_MATERIALS=0 -D GLINT=1 -D GROOVE=0 -D GLINT_COLOUR=0 -D SIZE_VARIATION=1 "
      "-D CONE_LIGHTS=1 -D LIGHT_CONE=0 -D DIFFUSE=0 -D COUNT_CELLS=0 -D GLINT_METHOD=zk16 -D "
      "KA=16 -D GGX=0 "
      "-D NORMAL_MAP=0 -D NORMAL_METHOD=mip -D LOBES=1 -D ANISOTROPY=1 -D HALF_TEXELS=0 "
      "-D LTC=0 -D LTC_METHOD=0 -D LIGHT_VERTICES=4 -D CLIPLESS=0 -D LIGHT_TEXTURE=0 -D "
      "MULTISCATTER=0 "
      "-D LOBE_MASKING=0 -D METAL_COMPENSATION=0 -D GRIDS=2 -D BINOMIAL=0 -D "
      "BINOMIAL_TERMS=16 -D MATHS=0 -D "
      "EDGES=0 -D LTC_HALF=0");
}

TEST(KernelConfig, OtherValuesAreWrittenAsEver) {
  KernelConfig config;
  config.width = 16;
  config.all_materials = true;
  config.glint = false;
  config.groove = config.glint_colour = config.light_cone = config.diffuse = config.count_cells =
      true;
  config.size_variation = false;
  config.method = GlintMethod::kExact;
  config.ka = 64;
  config.ggx = config.normal_map = config.half_texels = config.ltc = config.clipless = true;
  config.light_texture = config.lobe_masking = true;
  config.metal_compensation = MetalCompensation::kScaled;
  config.normal_method = NormalMethod::kGmm;
  config.lobes = 8;
  config.anisotropy = 16;
  config.ltc_method = LtcMethod::kExact;
  config.light_vertices = 8;
  config.multiscatter = Multiscatter::kEon;
  config.grids = 1;
  config.binomial = BinomialForm::kCapped;
  config.binomial_terms = 64;
  config.maths = Maths::kNative;
  config.edges = EdgeIntegral::kRational;
  config.ltc_half = true;
  EXPECT_PRED2(
      startsWith, buildOptions(config),
      "-D WIDTH=16 -D ALL_MATERIALS=1 -D GLINT=0 -D GROOVE=1 -D GLINT_COLOUR=1 -D SIZE_VARIATION=0 "
      "-D CONE_LIGHTS=1 -D LIGHT_CONE=1 -D DIFFUSE=1 -D COUNT_CELLS=1 -D GLINT_METHOD=exact -D "
      "KA=64 -D GGX=1 "
      "-D NORMAL_MAP=1 -D NORMAL_METHOD=gmm -D LOBES=8 -D ANISOTROPY=16 -D HALF_TEXELS=1 "
      "-D LTC=1 -D LTC_METHOD=2 -D LIGHT_VERTICES=8 -D CLIPLESS=1 -D LIGHT_TEXTURE=1 -D "
      "MULTISCATTER=3 "
      "-D LOBE_MASKING=1 -D METAL_COMPENSATION=1 -D GRIDS=1 -D BINOMIAL=3 -D "
      "BINOMIAL_TERMS=64 -D MATHS=1 -D "
      "EDGES=2 -D LTC_HALF=1");
}

TEST(KernelConfig, EverySwitchShows) {
  std::string expected;
  for (const Switch& row : allSwitches())
    expected += "-D " + std::string(row.macro) + "=" + row.textOf(row.of({})) + " ";
  expected.pop_back();
  EXPECT_EQ(buildOptions({}), expected);
}

// They are no options of their own: what is recorded does not name them.
TEST(KernelConfig, ProgramsForAllMaterialsGetABitForEachBranch) {
  KernelConfig config;
  EXPECT_EQ(programOptions(config), buildOptions(config));
  config.all_materials = true;
  EXPECT_PRED2(startsWith, programOptions(config),
               buildOptions(config) +
                   " -D EFFECT_GLINT=1u -D EFFECT_GROOVE=2u -D EFFECT_GLINT_COLOUR=4u "
                   "-D EFFECT_DIFFUSE=8u -D EFFECT_NORMAL_MAP=16u -D EFFECT_LTC=32u "
                   "-D EFFECT_MULTISCATTER=64u -D EFFECT_METAL_COMPENSATION=128u");
  config.glint = false;
  EXPECT_EQ(effectBits(config), 0u);
  config.groove = config.diffuse = true;
  config.multiscatter = Multiscatter::kEon;
  EXPECT_EQ(effectBits(config), 2u | 8u | 64u);
}

TEST(KernelConfig, PlanesBecomeTheirSlots) {
  KernelConfig config;
  config.planes = {Plane::kDepth, Plane::kPixel, Plane::kDvdx};
  EXPECT_TRUE(buildOptions(config).ends_with(" -D PLANE_PIXEL=0 -D PLANE_DVDX=1 -D PLANE_DEPTH=2"));
  config.planes = PlaneMask::all();
  EXPECT_TRUE(buildOptions(config).ends_with(
      " -D PLANE_PIXEL=0 -D PLANE_U_INT=1 -D PLANE_V_INT=2 -D PLANE_U_FRAC=3 -D PLANE_V_FRAC=4"
      " -D PLANE_DUDX=5 -D PLANE_DVDX=6 -D PLANE_DUDY=7 -D PLANE_DVDY=8 -D PLANE_FRAME0=9"
      " -D PLANE_FRAME1=10 -D PLANE_DEPTH=11 -D PLANE_DNX_DX=12 -D PLANE_DNY_DX=13"
      " -D PLANE_DNZ_DX=14 -D PLANE_DNX_DY=15 -D PLANE_DNY_DY=16 -D PLANE_DNZ_DY=17"));
}

TEST(KernelConfig, DifferentConfigsGiveDifferentOptions) {
  std::set<std::string> seen;
  for (int bits = 0; bits < 1 << 15; ++bits) {
    KernelConfig config;
    config.glint = bits & 1;
    config.groove = bits & 2;
    config.glint_colour = bits & 4;
    config.size_variation = bits & 8;
    config.light_cone = bits & 16;
    config.diffuse = bits & 32;
    config.count_cells = bits & 64;
    config.ggx = bits & 128;
    config.normal_map = bits & 256;
    config.half_texels = bits & 512;
    config.ltc = bits & 1024;
    config.clipless = bits & 2048;
    config.light_texture = bits & 4096;
    config.metal_compensation =
        bits & 8192 ? MetalCompensation::kKullaConty : MetalCompensation::kOff;
    config.all_materials = bits & 16384;
    seen.insert(buildOptions(config));
  }
  EXPECT_EQ(seen.size(), std::size_t{1} << 15);
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
  for (int lobes : {0, 9}) {
    KernelConfig config;
    config.lobes = lobes;
    EXPECT_EQ(errorOf([&] { buildOptions(config); }),
              "lobe count " + std::to_string(lobes) + " is out of range; it must be 1 to 8");
  }
  for (int anisotropy : {0, 17}) {
    KernelConfig config;
    config.anisotropy = anisotropy;
    EXPECT_EQ(errorOf([&] { buildOptions(config); }),
              "anisotropy " + std::to_string(anisotropy) + " is out of range; it must be 1 to 16");
  }
  for (int vertices : {2, 9}) {
    KernelConfig config;
    config.light_vertices = vertices;
    EXPECT_EQ(
        errorOf([&] { buildOptions(config); }),
        "light vertex count " + std::to_string(vertices) + " is out of range; it must be 3 to 8");
  }
  for (int ka : {-5, 0, 65}) {
    KernelConfig config;
    config.ka = ka;
    EXPECT_EQ(errorOf([&] { buildOptions(config); }),
              "ka " + std::to_string(ka) + " is out of range; it must be 1 to 64");
  }
  KernelConfig config;
  config.ltc_method = static_cast<LtcMethod>(5);
  EXPECT_EQ(errorOf([&] { buildOptions(config); }),
            "area light method 5 is unknown; it must be 0 (original), 1 (tao21), 2 (exact), 3 "
            "(mixture) or 4 (covariance)");
}

}  // namespace
}  // namespace glintmark
