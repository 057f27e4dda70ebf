// Files with one bit wrong.
#pragma once
#include <cstddef>
#include <string>

namespace glintmark {

/// Calls `check(damaged, place)` with each bit of the first `head` bytes of `good` turned over, and
/// with some bit of every `step`-th byte behind those.
template <class Check>
void withEachBitFlipped(const std::string& good, std::size_t head, std::size_t step,
                        const Check& check) {
  std::string damaged = good;
  const auto flip = [&](std::size_t at, std::size_t bit) {
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
    check(damaged, std::to_string(at) + " bit " + std::to_string(bit));
    damaged[at] = good[at];
  };
  for (std::size_t at = 0; at < head && at < good.size(); ++at)
    for (std::size_t bit = 0; bit < 8; ++bit) flip(at, bit);
  for (std::size_t at = head; at < good.size(); at += step) flip(at, at / step % 8);
}

}  // namespace glintmark
