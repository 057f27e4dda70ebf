// [CSDD20]: an elliptical average of cells, each with the product of two marginal distributions of
// slopes. Sums the distributions' lobes itself.
#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "host/reference/rivals.h"
#include "host/reference/seeds.h"

namespace glintmark::reference {
namespace {

constexpr double kHalfTurn = std::numbers::pi;  // [rad]
constexpr std::uint32_t kDistributions = 192;
constexpr int kLevels = 16, kNodes = 64;
constexpr double kReach = 2 * std::numbers::sqrt2;  // four standard deviations
constexpr double kLobeSigma = 0.02 / 0.5;
constexpr double kMostLobeSlope = kReach - 2 * kLobeSigma;
constexpr double kLobePeak = std::numbers::sqrt2 * kLobeSigma;
constexpr double kMostSlopeSquared = 17;
constexpr int kAuthorsFinest = -15, kLastOfBox = 100;

std::uint32_t dictionaryBits(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7FEB352Du;
  h = (h ^ (h >> 15)) * 0x846CA68Bu;
  return h ^ (h >> 16);
}

// The digits of a number behind the binary point, in reverse, plus a half.
double turnedRadicalInverse(std::uint32_t i) {
  double value = 0.5, digit = 0.5;
  for (; i != 0; i /= 2, digit /= 2) value += i % 2 * digit;
  return std::fmod(value, 1.0) + 0x1p-17;
}

// The mean slope of a lobe, by the protocol.
double lobeSlope(std::uint32_t lobe, std::uint32_t which, bool as_published) {
  double share = uniformOf(dictionaryBits(lobe * 0x9E3779B1u + which * 0x85EBCA77u)),
         variance = 0.5;
  if (!as_published) {
    const std::uint32_t h = dictionaryBits(lobe * 0x9E3779B1u + 0x632BE5ABu);
    const std::uint32_t step = h % 32 * 6 + ((h >> 5 & 1u) != 0 ? 5 : 1);
    share =
        ((step * which + (h >> 8) % kDistributions) % kDistributions + turnedRadicalInverse(lobe)) /
        kDistributions;
    variance -= kLobeSigma * kLobeSigma + std::pow(kReach / kNodes, 2) / 6;
  }
  return -std::sqrt(2 * variance) * boost::math::erfc_inv(2 * share);
}

using HalfDistribution = std::array<double, kNodes>;

HalfDistribution summedLobes(int level, std::uint32_t which, bool as_published) {
  HalfDistribution nodes{};
  for (std::uint32_t lobe = 0; lobe < 1u << level; ++lobe) {
    const double mean = std::min(std::abs(lobeSlope(lobe, which, as_published)), kMostLobeSlope);
    for (int i = 0; i < kNodes; ++i) {
      const double x = i * kReach / kNodes;
      if (std::abs(x - mean) > 8 * kLobeSigma && x + mean > 8 * kLobeSigma) continue;
      nodes[static_cast<std::size_t>(i)] += std::exp(-0.5 * std::pow((x - mean) / kLobeSigma, 2)) +
                                            std::exp(-0.5 * std::pow((x + mean) / kLobeSigma, 2));
    }
  }
  // Lines between the nodes enclose 1/2.
  double sum = 0;
  for (int i = 0; i < kNodes; ++i) sum += (i == 0 ? 0.5 : 1.0) * nodes[static_cast<std::size_t>(i)];
  for (double& node : nodes) node *= 0.5 / (sum * kReach / kNodes);
  return nodes;
}

}  // namespace

double chermainMarginal(int level, std::uint32_t which, bool as_published, double slope) {
  using Key = std::pair<int, std::pair<std::uint32_t, bool>>;
  static std::mutex mutex;
  static std::map<Key, HalfDistribution> made;
  const Key key = {level, {which, as_published}};
  const std::lock_guard lock(mutex);
  auto found = made.find(key);
  if (found == made.end()) found = made.emplace(key, summedLobes(level, which, as_published)).first;
  const double at = std::abs(slope) / kReach * kNodes;
  if (at >= kNodes) return 0;
  const auto node = static_cast<std::size_t>(at);
  const double next = node + 1 < kNodes ? found->second[node + 1] : 0;
  return std::lerp(found->second[node], next, at - static_cast<double>(node));
}

namespace {

// What a cell draws.
struct CellDraw {
  double turn_rad = 0;
  std::uint32_t x = 0, y = 0;  // which marginals
  double level = 0;
};

// What a light asks for.
struct SlopeLookup {
  glm::dvec2 slope{};     // over alpha
  double log2_count = 0;  // lobes in a cell of one uv
  bool one_axis = false;
  bool as_published = false;
  double size_variation = 0;
};

double authorsHash(std::uint32_t n) {  // [0, 1), 23 bits of it
  n ^= n << 13;
  n = n * (n * n * 15731u + 789221u) + 1376312589u;
  return static_cast<double>((n & 0x7FFFFFFFu) >> 8) * 0x1p-23;
}

CellDraw drawnByAuthors(std::int64_t u, std::int64_t v, int level, double log2_count,
                        bool one_axis) {
  const auto seed = static_cast<std::uint32_t>(
      static_cast<std::uint64_t>((u + 1549 * v) * (std::int64_t{1} << (level - kAuthorsFinest))));
  const double z =
      std::numbers::sqrt2 * boost::math::erf_inv(2 * (authorsHash(seed * 2171u) + 0x1p-24) - 1);
  return {2 * kHalfTurn * authorsHash(seed),
          static_cast<std::uint32_t>(authorsHash(seed * 16807u) * kDistributions),
          static_cast<std::uint32_t>(authorsHash(seed * 48271u) * kDistributions),
          std::floor(log2_count / (one_axis ? 1 : 2) + 2 * z + 0.5)};
}

std::uint32_t pairOf(std::uint32_t s, std::uint32_t j) {
  s = (s ^ j) * 0x846CA68Bu;
  s = (s ^ (s >> 15)) * 0xC2B2AE3Du;
  return s ^ (s >> 16);
}

CellDraw drawnEvenly(std::int64_t u, std::int64_t v, double log2_count, const SlopeLookup& lookup) {
  const std::uint32_t s = cellSeed(wrapped(u), wrapped(v));
  const std::uint32_t a = pairOf(s, 0), b = pairOf(s, 1);
  const double variation = lookup.size_variation;
  if (variation > 0)
    log2_count += std::sqrt(std::log1p(variation * variation)) * gaussOf(s * 0x2C1B3C6Du) *
                  std::numbers::log2e;
  // Lobes come in fours, or in pairs.
  const double images = lookup.one_axis ? 2 : 4;
  const double level = std::max((log2_count - std::log2(images)) / std::log2(images), 0.0);
  const double floor = std::floor(level);
  const double odds =
      (1 - std::pow(images, floor - level)) / (1 - 1 / images);  // of the next level
  return {2 * kHalfTurn * (a >> 16) / 65536, (a & 0xFFFFu) * kDistributions >> 16,
          (b & 0xFFFFu) * kDistributions >> 16, floor + ((b >> 16) / 65536.0 < odds ? 1 : 0)};
}

double cellRatio(const CellDraw& draw, const SlopeLookup& lookup) {
  if (draw.level >= kLevels) return 1;
  const int level = static_cast<int>(std::max(draw.level, 0.0));
  const glm::dvec2 h = lookup.slope;
  const double c = std::cos(draw.turn_rad), s = std::sin(draw.turn_rad);
  const glm::dvec2 turned =
      lookup.one_axis ? glm::dvec2(0, h.y) : glm::dvec2(c * h.x + s * h.y, c * h.y - s * h.x);
  if (std::max(std::abs(turned.x), std::abs(turned.y)) >= kReach)
    return lookup.as_published ? 0 : 1;
  double density = chermainMarginal(level, draw.y, lookup.as_published, turned.y);
  if (!lookup.one_axis) density *= chermainMarginal(level, draw.x, lookup.as_published, turned.x);
  const double smooth = std::exp(-std::min(glm::dot(h, h), kMostSlopeSquared)) /
                        (lookup.one_axis ? std::sqrt(kHalfTurn) : kHalfTurn);
  return density / smooth;
}

double positionIn(FixedCoordinate c, int level) {
  return std::ldexp(c.integer + c.fraction * 0x1p-32, -level);
}

// The ellipse with the half axes' directions `x` and `y` [uv], widened by a cell, over a grid.
double gridAverage(const PixelFootprint& footprint, glm::dvec2 x, glm::dvec2 y, int level,
                   const SlopeLookup& lookup, RivalRatio& result) {
  x = glm::dvec2(std::ldexp(x.x, -level), std::ldexp(x.y, -level));
  y = glm::dvec2(std::ldexp(y.x, -level), std::ldexp(y.y, -level));
  // Cells stand at whole numbers; kept small, so that doubles hold them.
  const double u = positionIn(footprint.u, level) - 0.5, v = positionIn(footprint.v, level) - 0.5;
  const double ss = x.x * x.x + y.x * y.x + 1, tt = x.y * x.y + y.y * y.y + 1,
               st = x.x * x.y + y.x * y.y;
  const auto first_s = static_cast<std::int64_t>(std::ceil(u - std::sqrt(ss))),
             last_s = static_cast<std::int64_t>(std::floor(u + std::sqrt(ss))),
             first_t = static_cast<std::int64_t>(std::ceil(v - std::sqrt(tt))),
             last_t = static_cast<std::int64_t>(std::floor(v + std::sqrt(tt)));
  const std::int64_t columns = last_s - first_s + 1;
  double sum = 0, weights = 0;
  for (std::int64_t t = first_t; t <= last_t; ++t)
    for (std::int64_t s = first_s; s <= last_s; ++s) {
      if (lookup.as_published && (t - first_t) * columns + s - first_s > kLastOfBox) continue;
      const double ds = static_cast<double>(s) - u, dt = static_cast<double>(t) - v;
      const double r_sq = (tt * ds * ds - 2 * st * ds * dt + ss * dt * dt) / (ss * tt - st * st);
      if (r_sq >= 1) continue;
      const double count = lookup.log2_count + 2 * level;
      const CellDraw draw = lookup.as_published
                                ? drawnByAuthors(s, t, level, count, lookup.one_axis)
                                : drawnEvenly(s, t, count, lookup);
      const double weight = std::exp(-2 * r_sq) - std::exp(-2.0);
      sum += weight * cellRatio(draw, lookup);
      weights += weight;
      ++result.visited;
    }
  if (lookup.as_published && (last_t - first_t + 1) * columns > kLastOfBox + 1)
    result.limited = true;
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

RivalRatio chermain(const PixelFootprint& footprint, const Glints& glints, const RivalLight& light,
                    bool as_published) {
  glm::dvec2 x = footprint.duv_dx, y = footprint.duv_dy;
  RivalRatio result;
  glm::dvec2 &longer = glm::length(x) >= glm::length(y) ? x : y, &shorter = &longer == &x ? y : x;
  if (glm::length(shorter) == 0) return {1, 0, false};
  const double most = as_published ? 8 : 16;
  if (const double stretch = glm::length(longer) / most / glm::length(shorter); stretch > 1) {
    shorter *= stretch;
    result.limited = stretch > 1.0001;
  }

  SlopeLookup lookup;
  lookup.one_axis = glints.groove;
  lookup.as_published = as_published;
  lookup.size_variation = glints.size_variation;
  lookup.slope = glm::dvec2(light.half) / light.half.z / glints.alpha_g;
  if (glints.groove) lookup.slope.x = 0;
  const double slope_sq = std::min(glm::dot(lookup.slope, lookup.slope), kMostSlopeSquared);
  const double lobe_peak = glints.groove ? kLobePeak : kLobePeak * kLobePeak;
  const double per_probability = glints.density / lobe_peak;
  lookup.log2_count =
      std::log2(per_probability * light.probability) + slope_sq * std::numbers::log2e;

  const glm::dvec2 alpha_ratio = glints.alpha_l / glints.alpha_g;
  const double peak = glints.groove ? alpha_ratio.y : alpha_ratio.x * alpha_ratio.y;
  int finest = kAuthorsFinest;
  if (!as_published) {  // cells of the first level's lobes at least
    const double count = per_probability * peak / (glints.groove ? 2 : 4);
    finest = static_cast<int>(std::ceil(-0.5 * std::log2(count)));
  }
  const double level = std::max(std::log2(glm::length(shorter)), static_cast<double>(finest));
  const int below = static_cast<int>(std::floor(level));
  const double fine = gridAverage(footprint, x, y, below, lookup, result),
               coarse = gridAverage(footprint, x, y, below + 1, lookup, result);
  result.ratio = std::lerp(fine, coarse, level - below);
  return result;
}

}  // namespace glintmark::reference
