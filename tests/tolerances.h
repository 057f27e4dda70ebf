// Bounds that several tests share, each with its reason. Those that `glintmark verify` shares as
// well stand in host/harness/tolerances.h.
#pragma once
#include "host/harness/tolerances.h"

namespace glintmark {

/// Machine instructions by which two programs differ that only find their planes in other slots:
/// constants of four address computations. The smallest effect (metal compensation) takes 20.
inline constexpr double kPlaneSlotInstructions = 8;

}  // namespace glintmark
