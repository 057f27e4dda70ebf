// Knobs on their way from ShadingOptions to the programs: to those that have their effect, with the
// table's defaults, and to no others.
#include <gtest/gtest.h>

#include "host/core/error.h"
#include "host/frame/effects.h"
#include "host/ocl/switches.h"
#include "tests/frame/frame_test.h"

namespace glintmark {
namespace {

constexpr const char* kKnobs[] = {
#define KNOB_ELSE(macro, ...) #macro,
#include "host/ocl/switches.inc"
};

// A value other than the default.
int anotherValue(const Switch& row) {
  return row.standard == row.values.least ? row.values.most : row.values.least;
}

// The knobs as a program with every effect has them.
KernelConfig everyEffect(const ShadingOptions& options) {
  KernelConfig config;
  config.glint = config.normal_map = config.ltc = true;
  for (bool KernelConfig::*effect :
       {kEveryProgram, &KernelConfig::glint, &KernelConfig::normal_map, &KernelConfig::ltc})
    setKnobs(options, effect, config);
  return config;
}

TEST(Knobs, ReachProgramsWithTheirEffect) {
  for (const char* macro : kKnobs) {
    const Switch& row = switchNamed(macro);
    ShadingOptions options;
    EXPECT_EQ(row.of(everyEffect(options)), row.standard) << macro;
    turnKnob(options, macro, anotherValue(row));
    const KernelConfig turned = everyEffect(options);
    EXPECT_EQ(row.of(turned), anotherValue(row)) << macro;
    for (const Switch& other : allSwitches()) {
      if (other.macro == row.macro) continue;
      EXPECT_EQ(other.of(turned), other.of(everyEffect({}))) << macro << " turned " << other.macro;
    }
  }
}

TEST(Knobs, LeaveProgramsWithoutTheirEffectAlone) {
  Scene smooth = floorScene();
  smooth.materials[0].has_glints = false;
  ASSERT_TRUE(smooth.area_lights.empty() && !smooth.materials[0].normal_map);
  const auto program = [&](const ShadingOptions& options) {
    return buildOptions(configFor(smooth.materials[0], smooth, options, 4));
  };
  for (const char* macro : kKnobs) {
    ShadingOptions options;
    turnKnob(options, macro, anotherValue(switchNamed(macro)));
    const bool of_every_program = std::string_view(macro) == "MATHS";
    EXPECT_EQ(program(options) != program({}), of_every_program) << macro;
  }
}

TEST(Knobs, WrongOnesAreErrors) {
  const auto turned = [](const char* macro, int value) {
    try {
      ShadingOptions options;
      turnKnob(options, macro, value);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(turned("KA", 64), "");
  EXPECT_EQ(turned("KA", 65), "KA cannot be 65");
  EXPECT_EQ(turned("WIDTH", 4), "WIDTH is a switch, but no knob");
  EXPECT_EQ(turned("KAA", 4), "no switch is called KAA");
}

}  // namespace
}  // namespace glintmark
