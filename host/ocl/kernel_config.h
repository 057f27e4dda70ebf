// Every compile-time switch of the kernels in one plain struct.
#pragma once
#include <compare>
#include <string>

#include "host/core/planes.h"

namespace glintmark {

enum class GlintMethod : int {
  kZk16 = 0,   // the paper's text: at most ka steps along the footprint, two grids
  kExact = 1,  // uncapped, true parallelogram coverage, exact binomial quantile
};

/// Keys the program cache (memory and disk) and is stored with every record. The meaning and range
/// of each switch stand in kernels/config.clh.
struct KernelConfig {
  int width = 1;  // lanes W: 1, 4, 8 or 16
  bool glint = true;
  bool groove = false;
  bool glint_colour = false;
  bool size_variation = true;
  bool light_cone = false;  // some light is wider than a point
  bool diffuse = false;
  bool count_cells = false;
  GlintMethod method = GlintMethod::kZk16;
  int ka = 16;       // K_a, steps along the footprint per grid, 1..64
  PlaneMask planes;  // planes in the buffer; each becomes PLANE_<NAME> = its slot

  bool operator==(const KernelConfig&) const = default;
};

/// The only place that writes -D: options for clBuildProgram, e.g. "-D WIDTH=16 -D GLINT=1 ...".
std::string buildOptions(const KernelConfig& config);

}  // namespace glintmark
