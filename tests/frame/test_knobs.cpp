// Knobs on their way from ShadingOptions to the programs: to those that have their effect, with the
// table's defaults, and to no others.
#include <gtest/gtest.h>

#include "host/core/error.h"
#include "host/frame/effects.h"
#include "host/ocl/switches.h"
#include "tests/frame/frame_test.h"

namespace glintmark {
namespace {

struct Knob {
  const char* macro;
  bool KernelConfig::*effect;
};
const Knob kKnobs[] = {
#define KNOB_ELSE(macro, type, member, standard, without, values, effect, ...) {#macro, effect},
#include "host/ocl/switches.inc"
};

// A value other than the default.
int anotherValue(const Switch& row) {
  return row.standard == row.values.least ? row.values.most : row.values.least;
}

// The knobs as a program with every effect has them.
KernelConfig everyEffect(const ShadingOptions& options) {
  KernelConfig config;
  for (const Knob& knob : kKnobs) {
    if (knob.effect != kEveryProgram) config.*knob.effect = true;
    setKnobs(options, knob.effect, config);
  }
  return config;
}

TEST(Knobs, ReachProgramsWithTheirEffect) {
  for (const Knob& knob : kKnobs) {
    const Switch& row = switchNamed(knob.macro);
    ShadingOptions options;
    EXPECT_EQ(row.of(everyEffect(options)), row.standard) << knob.macro;
    turnKnob(options, knob.macro, anotherValue(row));
    const KernelConfig turned = everyEffect(options);
    EXPECT_EQ(row.of(turned), anotherValue(row)) << knob.macro;
    for (const Switch& other : allSwitches()) {
      if (other.macro == row.macro) continue;
      EXPECT_EQ(other.of(turned), other.of(everyEffect({})))
          << knob.macro << " turned " << other.macro;
    }
  }
}

TEST(Knobs, LeaveProgramsWithoutTheirEffectAlone) {
  Scene smooth = floorScene();
  smooth.materials[0].has_glints = false;
  ASSERT_TRUE(smooth.area_lights.empty() && !smooth.materials[0].normal_map);
  const auto program = [&](const ShadingOptions& options) {
    return configFor(smooth.materials[0], smooth, options, 4);
  };
  std::size_t left_alone = 0;
  for (const Knob& knob : kKnobs) {
    ShadingOptions options;
    turnKnob(options, knob.macro, anotherValue(switchNamed(knob.macro)));
    const bool concerned = knob.effect == kEveryProgram || program({}).*knob.effect;
    EXPECT_EQ(buildOptions(program(options)) != buildOptions(program({})), concerned) << knob.macro;
    left_alone += concerned ? 0 : 1;
  }
  EXPECT_GE(left_alone, 12u);  // of glints, normal maps and area lights
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
