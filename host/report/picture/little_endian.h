// Numbers in the bytes of files.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace glintmark {

/// Of `count` bytes, at most 8, from `at` on, the least significant first; all must be there.
inline std::uint64_t littleEndian(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

}  // namespace glintmark
