// The host's side of kernels/mixture/mixture_fit.h.
#pragma once
#include "host/core/shared_types.h"

namespace glintmark {

#include "kernels/mixture/mixture_fit.h"

static_assert(sizeof(MixtureFitRun) == 112);

}  // namespace glintmark
