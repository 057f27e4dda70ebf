// The number of reflecting microdetails under a pixel drawn as what it is, one binomial per pixel:
// the truth where there are too many microdetails to place.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/microdetail/detail_tables.h"

namespace glintmark {

/// Pixels' ratios to the smooth lobe, k / (details p), those of the same pixels after a motion, and
/// of the same `larger` times as large.
struct BinomialFrames {
  std::vector<float> still, moved, zoomed;
};

/// Draws for `pixels` pixels of `details` microdetails on average, each of which reflects with
/// `probability` p: k is binomial (CountLaw::kFixed; a fraction of a microdetail is one by chance)
/// or Poisson. A motion leaves the share `kept` of a pixel's area in it: so many of its
/// microdetails stay, and as many as left come in. A pixel of `larger` times the area keeps all of
/// them. Neighbours know nothing of each other. Throws Error unless details > 0, 0 < p <= 1,
/// 0 <= kept <= 1 and larger >= 1.
BinomialFrames binomialFrames(std::size_t pixels, double details, double probability, double kept,
                              CountLaw law, std::uint32_t seed, double larger = 1);

}  // namespace glintmark
