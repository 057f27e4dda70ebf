// Values without repeats, numbered in the order in which they came.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace glintmark {

/// A hash table of values by their number, four bytes each. T has == and a hash() of 64 bits, all
/// of which count.
template <typename T>
class DistinctValues {
 public:
  /// The number of the value that equals `value`: a new one, size() before the call, if none does.
  std::uint32_t add(const T& value) {
    if (slots_.size() < values_.size() + values_.size() / 2 + 1) grow();
    std::uint32_t& slot = slots_[slotOf(value)];
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(values_.size());
      values_.push_back(value);
    }
    return slot;
  }

  std::size_t size() const { return values_.size(); }
  /// Hands the values over, in the order of their numbers, and frees the table.
  std::vector<T> take() {
    slots_ = {};
    return std::exchange(values_, {});
  }

 private:
  /// Where a value stands in the table, or could.
  std::size_t slotOf(const T& value) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = value.hash() & mask;
    while (slots_[at] != kEmpty && !(values_[slots_[at]] == value)) at = (at + 1) & mask;
    return at;
  }

  void grow() {
    slots_.assign(std::max<std::size_t>(2 * slots_.size(), 1024), kEmpty);
    for (std::size_t i = 0; i < values_.size(); ++i)
      slots_[slotOf(values_[i])] = static_cast<std::uint32_t>(i);
  }

  static constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;
  std::vector<std::uint32_t> slots_;
  std::vector<T> values_;
};

}  // namespace glintmark
