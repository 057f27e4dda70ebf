#include "host/core/unknown_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/core/error.h"

namespace glintmark {
namespace {

// Fewest letters to change, add or leave out, or neighbours to swap, from one name to the other.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> far(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& here = far[i][j];
      if (i == 0 || j == 0) {
        here = i + j;
        continue;
      }
      here = std::min({far[i - 1][j] + 1, far[i][j - 1] + 1,
                       far[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        here = std::min(here, far[i - 2][j - 2] + 1);
    }
  }
  return far.back().back();
}

// The known name that was most likely meant; empty where none is near.
std::string nearestName(std::string_view name, std::span<const std::string> known) {
  std::string nearest;
  std::size_t least = 1 + name.size() / 4;
  for (const std::string& one : known) {
    const bool begins = name.size() >= 3 && one.starts_with(name);
    const std::size_t distance = begins ? 1 : editDistance(name, one);
    if (distance > least || (distance == least && !nearest.empty())) continue;
    nearest = one;
    least = distance;
  }
  return name.empty() ? "" : nearest;
}

}  // namespace

std::string listOf(std::span<const std::string> items, std::string_view last_word) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 < items.size() ? ", " : fmt::format(" {} ", last_word);
    text += items[i];
  }
  return text;
}

std::string unknownName(const std::string& kind, const std::string& name,
                        std::span<const std::string> known, const std::string& kinds) {
  const std::string plural = kinds.empty() ? kind + "s" : kinds;
  std::string text = fmt::format("unknown {} '{}'; ", kind, name);
  text += known.empty() ? fmt::format("there are no {}", plural)
                        : fmt::format("{} are {}", plural, fmt::join(known, ", "));
  const std::string nearest = nearestName(name, known);
  return nearest.empty() ? text : fmt::format("{}; did you mean {}?", text, nearest);
}

void requireKnownName(const std::string& kind, const std::string& name,
                      std::span<const std::string> known, const std::string& kinds) {
  if (std::ranges::find(known, name) == known.end())
    throw Error(unknownName(kind, name, known, kinds));
}

}  // namespace glintmark
