// The number of reflecting microdetails under a pixel drawn as what it is, one binomial per pixel:
// the truth where there are too many microdetails to place.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/microdetail/detail_tables.h"

namespace glintmark {

/// Draws of k / (details p) for `pixels` pixels of `details` microdetails on average, each of which
/// reflects with `probability` p: k is binomial (CountLaw::kFixed; a fraction of a microdetail is
/// one by chance) or Poisson. Neighbours know nothing of each other, so it says nothing about
/// motion. Throws Error unless details > 0 and 0 < p <= 1.
std::vector<float> binomialRatios(std::size_t pixels, double details, double probability,
                                  CountLaw law, std::uint32_t seed);

}  // namespace glintmark
