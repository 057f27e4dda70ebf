#include "host/fit/slope_dictionary.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace glintmark {
namespace {

constexpr double kStep = double{DICTIONARY_REACH} / DICTIONARY_NODES;
constexpr double kLobe = DICTIONARY_LOBE;
constexpr double kMostLobeSlope = double{DICTIONARY_REACH} - 2 * kLobe;  // lobes lie within
constexpr int kReachOfLobe = 7;  // nodes on either side: beyond lie 1e-13 of its peak
constexpr std::uint32_t kLobeSalt = 0x9E3779B1u, kDistributionSalt = 0x85EBCA77u;

constexpr int kEvenBits = 16;

using LobeNodes = std::array<double, DICTIONARY_NODES>;

std::uint32_t scrambled(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  return h ^ (h >> 16);
}

double uniformAt(std::uint32_t lobe, std::uint32_t distribution) {
  return (scrambled(lobe * kLobeSalt + distribution * kDistributionSalt) + 0.5) * 0x1p-32;
}

// The slope over alpha of a lobe, from a share of slopes below it.
double slopeOf(double share, double variance) {
  return std::sqrt(2 * variance) * boost::math::erf_inv(2 * share - 1);
}

// Within a stratum lobes stand by van der Corput's sequence, turned by a half: those of each level
// are even together.
double evenWithin(std::uint32_t lobe) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < kEvenBits; ++bit) reversed |= (lobe >> bit & 1u) << (kEvenBits - 1 - bit);
  constexpr std::uint32_t kWhole = 1u << kEvenBits;
  return ((reversed + kWhole / 2) % kWhole + 0.5) / kWhole;
}

// Lobes of one number are a permutation of even shares: their numbers times a factor that has no
// divisor of the size, and an offset.
double stratifiedShare(std::uint32_t lobe, std::uint32_t distribution) {
  const std::uint32_t h = scrambled(lobe * kLobeSalt + 0x632BE5ABu);
  const std::uint32_t factor = 6 * (h % 32) + (h & 32u ? 5 : 1), offset = h >> 8;
  const std::uint32_t stratum =
      (factor * distribution + offset % DICTIONARY_SIZE) % DICTIONARY_SIZE;
  return (stratum + evenWithin(lobe)) / DICTIONARY_SIZE;
}

// Adds a Gaussian, 1 at its peak, around `from` >= 0 and its image around -from. From node to node
// its factor falls by a constant factor.
void addLobe(double from, LobeNodes& nodes) {
  static const double fall = std::exp(-kStep * kStep / (kLobe * kLobe));
  const int middle = static_cast<int>(from / kStep);
  for (const double at : {from, -from}) {
    const int first = std::max((at < 0 ? -middle : middle) - kReachOfLobe, 0);
    const int last = std::min((at < 0 ? -middle : middle) + kReachOfLobe, DICTIONARY_NODES - 1);
    if (first > last) continue;
    const double distance = first * kStep - at;
    double value = std::exp(-0.5 * distance * distance / (kLobe * kLobe));
    double factor = std::exp(-(distance + 0.5 * kStep) * kStep / (kLobe * kLobe));
    for (int i = first; i <= last; ++i) {
      nodes[static_cast<std::size_t>(i)] += value;
      value *= factor;
      factor *= fall;
    }
  }
}

// The trapezoids' sum is made 1/2.
void store(const LobeNodes& nodes, float* row) {
  double sum = -0.5 * nodes[0];
  for (const double value : nodes) sum += value;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    row[i] = static_cast<float>(nodes[i] / (2 * sum * kStep));
}

void fill(SlopeDraws draws, std::uint32_t distribution, std::vector<float>& dictionary) {
  const bool stratified = draws == SlopeDraws::kStratified;
  // What lobes and the lines between nodes add to the variance.
  const double variance = 0.5 - (stratified ? kLobe * kLobe + kStep * kStep / 6 : 0);
  LobeNodes nodes{};
  std::uint32_t lobe = 0;
  for (int level = 0; level < DICTIONARY_LEVELS; ++level) {
    for (; lobe < 1u << level; ++lobe) {
      const double share =
          stratified ? stratifiedShare(lobe, distribution) : uniformAt(lobe, distribution);
      addLobe(std::min(std::abs(slopeOf(share, variance)), kMostLobeSlope), nodes);
    }
    store(nodes, dictionary.data() + DICTIONARY_ROW(static_cast<std::size_t>(level), distribution));
  }
}

std::vector<float> makeDictionary(SlopeDraws draws) {
  std::vector<float> dictionary(std::size_t{DICTIONARY_LEVELS} * DICTIONARY_SIZE *
                                DICTIONARY_NODES);
  tbb::parallel_for(std::uint32_t{0}, std::uint32_t{DICTIONARY_SIZE},
                    [&](std::uint32_t i) { fill(draws, i, dictionary); });
  return dictionary;
}

}  // namespace

const std::vector<float>& slopeDictionary(SlopeDraws draws) {
  if (draws == SlopeDraws::kStratified) {
    static const std::vector<float> stratified = makeDictionary(draws);
    return stratified;
  }
  static const std::vector<float> independent = makeDictionary(draws);
  return independent;
}

}  // namespace glintmark
