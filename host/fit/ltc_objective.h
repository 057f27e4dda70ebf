// What the fit of a linearly transformed cosine minimises.
#pragma once
#include <array>

#include "host/fit/ltc_samples.h"

namespace glintmark {

/// Integral over the hemisphere of |lobe / its mass there - brdf / albedo|, in [0, 2], and its
/// derivatives in the order of LtcLobe.
///
/// Half of it is the largest error that any light, of whatever shape, can get: both integrate to 1,
/// so what one has too much in some directions it lacks in the others.
double ltcFitError(const LtcSamples& samples, const LtcLobe& lobe, std::array<double, 4>& gradient);

}  // namespace glintmark
