#include "host/frame/shading_options.h"

#include <fmt/format.h>

#include "host/core/error.h"
#include "host/ocl/switches.h"

namespace glintmark {

void setKnobs(const ShadingOptions& options, bool KernelConfig::*effect, KernelConfig& config) {
  if (effect != kEveryProgram && !(config.*effect)) return;
#define KNOB_ELSE(macro, type, member, standard, without, values, effect_of_knob, ...) \
  if (effect == (effect_of_knob)) config.member = options.member;
#include "host/ocl/switches.inc"
}

void turnKnob(ShadingOptions& options, std::string_view macro, int value) {
  const Switch& row = switchNamed(macro);
  if (!row.values.allow(value)) throw Error(fmt::format("{} cannot be {}", row.macro, value));
#define KNOB_ELSE(macro_of_knob, type, member, ...) \
  if (macro == #macro_of_knob) {                    \
    options.member = static_cast<type>(value);      \
    return;                                         \
  }
#include "host/ocl/switches.inc"
  throw Error(fmt::format("{} is a switch, but no knob", macro));
}

int checkedDrawnLights(int count) {
  const SwitchValues& values = switchNamed("DRAWN_LIGHTS").values;
  if (!values.allow(count))
    throw Error(fmt::format("--drawn-lights {} is not {} to {}", count, values.least, values.most));
  return count;
}

GlintMethod parseMethod(const std::string& name) {
  return parseChoice<GlintMethod>(name, "method");
}

std::string defaultMethod() {
  return choiceName(ShadingOptions{}.method);
}

std::string methodHelp(const std::string& by_default) {
  return fmt::format("{} (default: {})", listOf(namesOf<GlintMethod>(), "or"), by_default);
}

}  // namespace glintmark
