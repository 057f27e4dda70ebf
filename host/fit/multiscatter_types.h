// The host's side of kernels/scatter/multiscatter.h.
#pragma once
#include "host/core/shared_types.h"

namespace glintmark {

#include "kernels/scatter/multiscatter.h"

static_assert(sizeof(MultiscatterMaterial) == 256);
static_assert(sizeof(LightTaps) == 8);

}  // namespace glintmark
