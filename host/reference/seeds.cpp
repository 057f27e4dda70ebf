#include "host/reference/seeds.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace glintmark::reference {
namespace {

constexpr double kMostExpected = 0x1p30;
const double kByteSumSigma = std::sqrt(4.0 * (256.0 * 256.0 - 1.0) / 12.0);  // 147.8
constexpr double kLeastFactor = 1.0 / 32.0;

// (a + b) >> 16, arithmetic, wrapping like 32-bit integers.
std::int32_t cellOf(std::int32_t half, std::uint32_t shift) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(half) + shift) >> 16;
}

// The lower 32 bits of a number, and how many 2^32 it is from the nearest that has no others.
struct SplitIndex {
  std::uint32_t low = 0;
  std::uint32_t beyond = 0;
};
SplitIndex splitIndex(std::int64_t i) {
  const auto low = static_cast<std::uint32_t>(static_cast<std::uint64_t>(i));
  const std::int64_t near = static_cast<std::int32_t>(low);
  return {low, static_cast<std::uint32_t>(static_cast<std::uint64_t>((i - near) / 0x100000000))};
}

std::int64_t oddPart(std::int64_t i) {
  while (i != 0 && i % 2 == 0) i /= 2;
  return i;
}

}  // namespace

std::int32_t coherentIndex(std::int32_t i) {
  return i == 0 ? 0 : i >> std::countr_zero(static_cast<std::uint32_t>(i));
}

std::uint32_t cellSeed(std::int64_t cell_u, std::int64_t cell_v, std::uint32_t salt) {
  return plainCellSeed(oddPart(cell_u), oddPart(cell_v), salt);
}

std::uint32_t plainCellSeed(std::int64_t cell_u, std::int64_t cell_v, std::uint32_t salt) {
  const SplitIndex u = splitIndex(cell_u), v = splitIndex(cell_v);
  std::uint32_t s = u.low * 0x9E3779B1u + v.low * 0x85EBCA77u + salt;
  s ^= s >> 16;
  s *= 0x7FEB352Du;
  s ^= s >> 15;
  const std::uint32_t far = (u.beyond * 0x9E3779B1u + v.beyond * 0x85EBCA77u) * 0x846CA68Bu;
  return s ^ far ^ (far >> 15);
}

std::uint32_t pairSeed(std::uint32_t cell_seed, HalfVectorIndex half) {
  const auto j_u = static_cast<std::uint32_t>(cellOf(half.u, cell_seed & 0xFFFFu));
  const auto j_v = static_cast<std::uint32_t>(cellOf(half.v, cell_seed >> 16));
  std::uint32_t d = cell_seed ^ (j_u + j_v * 0x01000193u);
  d *= 0x846CA68Bu;
  d ^= d >> 15;
  d *= 0xC2B2AE3Du;
  d ^= d >> 16;
  return d;
}

double uniformOf(std::uint32_t h) {
  return (h + 0.5) * 0x1p-32;
}

double gaussOf(std::uint32_t h) {
  const std::uint32_t sum = (h & 0xFFu) + (h >> 8 & 0xFFu) + (h >> 16 & 0xFFu) + (h >> 24);
  return (static_cast<double>(sum) - 510.0) / kByteSumSigma;
}

double sizeFactor(std::uint32_t d, double size_variation) {
  if (size_variation <= 0) return 1;
  return std::max(std::abs(1.0 + size_variation * gaussOf(d * 0x2C1B3C6Du)), kLeastFactor);
}

double mostExpected(double size_variation) {
  return kMostExpected / (1.0 + 3.5 * size_variation);
}

std::int64_t wholeNumber(std::uint32_t d, double expected) {
  const double whole = std::floor(expected);
  return static_cast<std::int64_t>(whole) + (uniformOf(d * 0x297A2D39u) < expected - whole ? 1 : 0);
}

}  // namespace glintmark::reference
