// Binomial quantiles: exact, and by the rule of method zk16.
#pragma once
#include <cstdint>

namespace glintmark::reference {

/// Smallest k with P(K > k) <= u for K binomial of `count` and `p`; u in (0, 1]. By Boost.Math.
std::int64_t upperQuantile(double u, std::int64_t count, double p);

/// Step 8 of "The draws" in kernels/README.md for method `exact`: upperQuantile, up to a mean of 32
/// and from 24 on moving to the second-order Cornish-Fisher expansion; above p = 1/2 the
/// complement.
std::int64_t drawExact(double u, std::int64_t count, double p);

/// The same for method `zk16`: 5 and 3.75, first order, and beyond 16 terms the exponential tail.
/// [ZK16] Sect. 4.3
/// Method `distributed` has both means `limits` times as large where many microdetails of a pixel
/// reflect.
std::int64_t drawZk16(double u, std::int64_t count, double p, double limits = 1);

}  // namespace glintmark::reference
