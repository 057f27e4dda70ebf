// Arrays that may be gigabytes.
#pragma once
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace glintmark {

/// Bytes from which on a LargeArray begins on a page and lies in large pages, where the system has
/// them: fewer faults while it is filled, fewer look-ups of addresses while it is read.
inline constexpr std::size_t kLeastLargeBytes = std::size_t{4} << 20;

/// Memory that begins on a large page, for std::free(), and whether the system lays it in such
/// pages; null if there is none.
struct LargeMemory {
  void* begin = nullptr;
  bool in_large_pages = false;
};
LargeMemory largeMemory(std::size_t bytes);

/// Memory for so many items, on a page, for std::free(); throws std::bad_alloc.
void* allocateLarge(std::size_t count, std::size_t item_bytes);

/// Leaves elements that are not given a value as the memory is, so that threads may fill them;
/// what is not filled has no value.
template <typename T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <typename Other>
  explicit LargeAllocator(const LargeAllocator<Other>&) {}

  T* allocate(std::size_t count) {
    if (count * sizeof(T) < kLeastLargeBytes) return std::allocator<T>().allocate(count);
    return static_cast<T*>(allocateLarge(count, sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < kLeastLargeBytes)
      std::allocator<T>().deallocate(memory, count);
    else
      std::free(memory);
  }

  template <typename U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }

  bool operator==(const LargeAllocator&) const { return true; }
};

template <typename T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

}  // namespace glintmark
