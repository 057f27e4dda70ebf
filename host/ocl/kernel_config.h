// Every compile-time switch of the kernels in one plain struct.
#pragma once
#include <compare>
#include <string>

#include "host/core/planes.h"

namespace glintmark {

// GlintMethod, NormalMethod, LtcMethod, Multiscatter, BinomialForm, Maths and EdgeIntegral.
#define CHOICES(type) enum class type : int {
#define CHOICE(enumerator, ...) enumerator,
#define CHOICES_END \
  }                 \
  ;
#include "host/ocl/switches.inc"

/// Keys the program cache (memory and disk) and is stored with every record. A member for each row
/// of host/ocl/switches.inc, where its meaning and range stand. Knobs start as they are in programs
/// without their effect.
struct KernelConfig {
#define SWEPT_SWITCH(macro, type, member, standard, ...) type member = standard;
#define KNOB_ELSE(macro, type, member, standard, without, ...) type member = without;
#include "host/ocl/switches.inc"
  PlaneMask planes;  // planes in the buffer; each becomes PLANE_<NAME> = its slot

  bool operator==(const KernelConfig&) const = default;
};

/// In place of an effect: of knobs that every program has.
inline constexpr bool KernelConfig::*kEveryProgram = nullptr;

/// The only place that writes -D: options for clBuildProgram, e.g. "-D WIDTH=16 -D GLINT=1 ...".
/// Throws Error for values out of range.
std::string buildOptions(const KernelConfig& config);

}  // namespace glintmark
