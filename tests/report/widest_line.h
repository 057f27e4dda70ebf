// What tests of printed tables measure.
#pragma once
#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>

namespace glintmark {

/// Characters of the longest line.
inline std::size_t widestLine(const std::string& text) {
  std::istringstream lines(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, line.size());
  return widest;
}

}  // namespace glintmark
