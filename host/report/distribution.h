// Distance between distributions of values.
#pragma once
#include <span>

namespace glintmark {

/// Wasserstein distance W1 between the empirical distributions of two ascending samples: the area
/// between their distribution functions, in the unit of the values. Throws Error if one is empty.
double wassersteinDistance(std::span<const float> a, std::span<const float> b);

}  // namespace glintmark
