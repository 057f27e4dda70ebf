// Indices of grid cells for checks of seeds.
#pragma once
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace glintmark {

/// The ends of the range, all small indices, and random ones of every magnitude.
inline std::vector<std::int32_t> interestingIndices() {
  constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
  std::vector<std::int32_t> indices = {0, kMin, kMin + 1, kMax, kMax - 1, kMin / 2, 1 << 30};
  for (std::int32_t i = -2048; i <= 2048; ++i) indices.push_back(i);
  std::mt19937 random(7);
  for (int i = 0; i < 4096; ++i) {
    const auto bits = random();
    indices.push_back(static_cast<std::int32_t>(bits << (random() % 32)));
  }
  return indices;
}

}  // namespace glintmark
