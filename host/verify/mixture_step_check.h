// One EM step on the device from lobes that are given, against [TAN05] in double precision.
#pragma once
#include "host/verify/check.h"

namespace glintmark {

/// Weights, means and variances of every texel of a level after one step from given lobes, in all
/// rounds of the fit, where lanes are texels and where they are normals.
Finding oneStepFromGivenLobes(const CheckContext& context);

}  // namespace glintmark
