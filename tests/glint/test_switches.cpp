// Compile-time switches change nothing but the time: the same bits from every program that may
// shade a pixel.
#include <gtest/gtest.h>
#include <stdio.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

HandMadeFrame testFrame() {
  HandMadeFrame frame;
  frame.pixels = randomPixels(1003, {1e-4, 1e-2, 24});
  frame.material = simpleMaterial({0.3f, 0.2f}, {0.05f, 0.04f}, 1e6f, 1);
  frame.lights = {coneLight({-0.3, 0.2, 0.9}), coneLight({0.4, 0.1, 0.8}, 0, 0.3)};
  setRandomRays(frame);
  return frame;
}

KernelConfig baseConfig(int width = 16) {
  KernelConfig config;
  config.width = width;
  return config;
}

void expectSameBits(const ShadedPixels& a, const ShadedPixels& b, const std::string& what) {
  ASSERT_EQ(a.radiance.size(), b.radiance.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.radiance.size(); ++i) different += a.radiance[i] != b.radiance[i];
  EXPECT_EQ(different, 0u) << what << ", of " << a.radiance.size();
}

TEST(Switches, CountingCellsKeepsTheImage) {
  for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact}) {
    KernelConfig config = baseConfig();
    config.method = method;
    const ShadedPixels off = shadePixels(testBench(), testFrame(), config);
    config.count_cells = true;
    expectSameBits(off, shadePixels(testBench(), testFrame(), config), "counting");
  }
}

TEST(Switches, ConeOfNoWidthIsAPoint) {
  KernelConfig config = baseConfig();
  config.count_cells = true;
  const ShadedPixels off = shadePixels(testBench(), testFrame(), config);
  config.light_cone = true;
  const ShadedPixels on = shadePixels(testBench(), testFrame(), config);
  EXPECT_EQ(on.cells, off.cells);
  // A lobe with a general matrix rounds otherwise than one with two roughnesses.
  for (std::size_t i = 0; i < on.radiance.size(); ++i)
    EXPECT_NEAR(on.radiance[i].x, off.radiance[i].x, 1e-6 * off.radiance[i].x) << i;
}

TEST(Switches, SizeVariationOfZeroIsNone) {
  HandMadeFrame frame = testFrame();
  frame.material.glints.size_variation = 0;
  KernelConfig config = baseConfig();
  const ShadedPixels on = shadePixels(testBench(), frame, config);
  config.size_variation = false;
  expectSameBits(on, shadePixels(testBench(), frame, config), "size variation");
}

TEST(Switches, BlackAlbedoIsNoDiffuseTerm) {
  KernelConfig config = baseConfig();
  const ShadedPixels off = shadePixels(testBench(), testFrame(), config);
  config.diffuse = true;
  expectSameBits(off, shadePixels(testBench(), testFrame(), config), "diffuse");
}

TEST(Switches, OneWhiteColourIsNoColour) {
  HandMadeFrame frame = testFrame();
  frame.material.glints.palette_count = 1;
  frame.material.glints.palette[0] = {1, 1, 1, 0};
  KernelConfig config = baseConfig();
  const ShadedPixels off = shadePixels(testBench(), frame, config);
  config.glint_colour = true;
  const ShadedPixels on = shadePixels(testBench(), frame, config);
  // The colour enters as a sum of its own: a few units in the last place.
  for (std::size_t i = 0; i < on.radiance.size(); ++i)
    EXPECT_NEAR(on.radiance[i].y, off.radiance[i].y, 1e-5 * off.radiance[i].y) << i;
}

TEST(Switches, LightsAddUp) {
  HandMadeFrame both = testFrame(), first = both, second = both;
  first.lights.pop_back();
  second.lights.erase(second.lights.begin());
  const ShadedPixels sum = shadePixels(testBench(), both, baseConfig());
  const ShadedPixels a = shadePixels(testBench(), first, baseConfig()),
                     b = shadePixels(testBench(), second, baseConfig());
  for (std::size_t i = 0; i < sum.radiance.size(); ++i)
    EXPECT_NEAR(sum.radiance[i].x, a.radiance[i].x + b.radiance[i].x,
                1e-6 * sum.radiance[i].x + 1e-12);
}

// shade.cl after the preprocessor.
std::string preprocessed(const KernelConfig& config) {
  KernelConfig with_planes = config;
  with_planes.planes = PlaneMask::all();
  const std::string command = "g++ -E -P -x c -I '" + kernelFolder() + "' " +
                              buildOptions(with_planes) + " '" + kernelFolder() + "/shade.cl' 2>&1";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  char chunk[4096];
  while (pipe && fgets(chunk, sizeof chunk, pipe.get())) text += chunk;
  return text;
}

TEST(Switches, AbsentEffectsLeaveNoFunctionBehind) {
  struct Effect {
    const char* name;
    bool KernelConfig::*flag;
    std::vector<std::string> functions;
  };
  const Effect effects[] = {
      {"GLINT",
       &KernelConfig::glint,
       {"glintRatio", "coherentIndex", "hashDirection", "makeFootprint", "makeBinomialOdds"}},
      {"GLINT_COLOUR", &KernelConfig::glint_colour, {"colourWheel", "cellColour"}},
      {"LIGHT_CONE", &KernelConfig::light_cone, {"coneLobe"}},
      {"GROOVE", &KernelConfig::groove, {"grooveDensity"}},
      {"SIZE_VARIATION", &KernelConfig::size_variation, {"byteSum"}},
      {"COUNT_CELLS", &KernelConfig::count_cells, {"cell_counts"}}};
  for (const Effect& effect : effects) {
    KernelConfig config = baseConfig();
    config.glint_colour = config.light_cone = config.diffuse = config.count_cells = true;
    config.groove = true;
    const std::string with = preprocessed(config);
    config.*effect.flag = false;
    if (!config.glint)
      config.groove = config.glint_colour = config.size_variation = config.count_cells = false;
    const std::string without = preprocessed(config);
    for (const std::string& function : effect.functions) {
      EXPECT_NE(with.find(function), std::string::npos) << function << " was renamed";
      EXPECT_EQ(without.find(function), std::string::npos) << effect.name << ": " << function;
    }
  }
}

// Every pair of switches in all four ways: the twelve runs of Plackett and Burman's 1946 design for
// eleven two-valued switches. Two of them choose the lanes. (Building is the slow part.)
TEST(Switches, EveryPairOfThemCompiles) {
  const std::string generator = "11011100010";
  for (std::size_t run = 0; run < 12; ++run) {
    const auto level = [&](std::size_t factor) {
      return run < 11 && generator[(factor + run) % 11] == '1';
    };
    KernelConfig config;
    config.groove = level(0);
    config.glint_colour = level(1);
    config.size_variation = level(2);
    config.light_cone = level(3);
    config.diffuse = level(4);
    config.count_cells = level(5);
    config.method = level(6) ? GlintMethod::kExact : GlintMethod::kZk16;
    config.ka = level(7) ? 16 : 1 + static_cast<int>(run) * 5;
    config.width = kAllWidths[(level(8) ? 2 : 0) + (level(9) ? 1 : 0)];
    config.planes = PlaneMask::all();
    EXPECT_NO_THROW(testBench().cache.get("shade.cl", config)) << buildOptions(config);
  }
}

TEST(Switches, EverySmoothProgramCompiles) {
  for (const int width : {1, 16})
    for (int bits = 0; bits < 4; ++bits) {
      KernelConfig config;
      config.width = width;
      config.glint = config.size_variation = false;
      config.light_cone = bits & 1;
      config.diffuse = bits & 2;
      config.planes = {Plane::kPixel, Plane::kFrame0, Plane::kFrame1};
      EXPECT_NO_THROW(testBench().cache.get("shade.cl", config)) << buildOptions(config);
    }
}

}  // namespace
}  // namespace glintmark
