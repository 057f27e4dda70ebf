// The host's side of kernels/scatter/heightfield.h.
#pragma once
#include "host/core/shared_types.h"

namespace glintmark {

#include "kernels/scatter/heightfield.h"

static_assert(sizeof(HeightfieldRun) == 64);

}  // namespace glintmark
