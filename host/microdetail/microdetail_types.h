// The host's side of kernels/microdetail/microdetail.h.
#pragma once
#include "host/core/shared_types.h"

namespace glintmark {

#include "kernels/microdetail/microdetail.h"

static_assert(sizeof(MicrodetailField) == 40);

}  // namespace glintmark
