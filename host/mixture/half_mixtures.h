// Mixtures of normals in half the memory.
//
// The moments of [TAN05] cannot be halves: 2 s^2 = m / a - |mean|^2 subtracts numbers near 1 that
// are good to 2^-11, which loses every s below 0.02. So a lobe is stored as what does not cancel,
// (a, mean.x, mean.y, s), each with a relative error of 2^-11, and is turned into moments in single
// precision after the fetch and before the filter. The mean's error, at most 2^-12, is that of a
// 12-bit normal map; the deviation stays good down to 6e-8.
#pragma once
#include <cstdint>
#include <vector>

#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// Four halves (a, mean.x, mean.y, s) a lobe, rounded to nearest, in the order of
/// `mixtures.moments`: the layout that HALF_TEXELS reads with vload_half4.
std::vector<std::uint16_t> packHalfMixtures(const NormalMixtures& mixtures);

/// The lobe in four halves.
NormalLobe lobeFromHalves(const std::uint16_t* halves);

}  // namespace glintmark
