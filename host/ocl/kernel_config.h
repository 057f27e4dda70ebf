// Every compile-time switch of the kernels in one plain struct.
#pragma once
#include <compare>
#include <cstdint>
#include <string>

#include "host/core/planes.h"

namespace glintmark {

// GlintMethod, NormalMethod, LtcMethod, Multiscatter, BinomialForm, Maths, EdgeIntegral,
// GeometricAa and LightCut.
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

/// Options for clBuildProgram as records name them, e.g. "-D WIDTH=16 -D GLINT=1 ...". Throws Error
/// for values out of range. It and programOptions() are the only places that write -D.
std::string buildOptions(const KernelConfig& config);

/// The same with all that the program needs to compile: if it is for all materials, the bits
/// EFFECT_<switch> by which it asks each of them, which say nothing of how it shades.
std::string programOptions(const KernelConfig& config);

/// SurfaceMaterial::effects of a material whose own program has this configuration.
std::uint32_t effectBits(const KernelConfig& config);

}  // namespace glintmark
