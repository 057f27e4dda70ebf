#include "host/core/large_array.h"

#include <limits>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace glintmark {

LargeMemory largeMemory(std::size_t bytes) {
  constexpr std::size_t kLargePageBytes = std::size_t{2} << 20;
  const std::size_t whole = (bytes + kLargePageBytes - 1) / kLargePageBytes * kLargePageBytes;
  LargeMemory memory{std::aligned_alloc(kLargePageBytes, whole)};
#ifdef MADV_HUGEPAGE
  memory.in_large_pages = memory.begin && ::madvise(memory.begin, whole, MADV_HUGEPAGE) == 0;
#endif
  return memory;
}

void* allocateLarge(std::size_t count, std::size_t item_bytes) {
  constexpr std::size_t kMost_bytes = std::numeric_limits<std::size_t>::max() / 4;
  if (count > kMost_bytes / item_bytes) throw std::bad_alloc();
  void* const memory = largeMemory(count * item_bytes).begin;
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace glintmark
