// The host's side of kernels/multiscatter.h.
#pragma once
#include "host/core/shared_types.h"

namespace glintmark {

#include "kernels/multiscatter.h"

static_assert(sizeof(MultiscatterMaterial) == 144);

}  // namespace glintmark
