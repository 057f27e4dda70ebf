// Vertices that are alike.
#pragma once
#include <cstdint>
#include <vector>

namespace glintmark {

/// A hash table of vertex numbers, four bytes each; what makes two alike is the caller's. `hash`
/// and `equal` take vertices.
class VertexTable {
 public:
  /// For at most `count` different vertices.
  explicit VertexTable(std::size_t count) {
    std::size_t size = 16;
    while (size < count + count / 2) size *= 2;
    slots_.assign(size, kEmpty);
  }

  /// The vertex put in first that equals `vertex`; itself if none does.
  template <typename Hash, typename Equal>
  std::uint32_t findOrAdd(std::uint32_t vertex, const Hash& hash, const Equal& equal) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash(vertex) & mask;; at = (at + 1) & mask) {
      if (slots_[at] == kEmpty) slots_[at] = vertex;
      if (slots_[at] == vertex || equal(slots_[at], vertex)) return slots_[at];
    }
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;
  std::vector<std::uint32_t> slots_;
};

/// Mixes a number into a hash so that every bit of both counts.
inline std::uint64_t mixedHash(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
  return hash ^ hash >> 29;
}

}  // namespace glintmark
