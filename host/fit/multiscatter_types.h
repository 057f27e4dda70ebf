// The host's side of kernels/multiscatter.h.
#pragma once
#include "host/core/shared_types.h"

namespace glintmark {

#include "kernels/multiscatter.h"

static_assert(sizeof(MultiscatterMaterial) == 208);

}  // namespace glintmark
