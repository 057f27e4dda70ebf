#include "host/core/large_array.h"

#include <limits>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace glintmark {

void* allocateLarge(std::size_t count, std::size_t item_bytes) {
  constexpr std::size_t kLargePageBytes = std::size_t{2} << 20;
  constexpr std::size_t kMost_bytes = std::numeric_limits<std::size_t>::max() / 4;
  if (count > kMost_bytes / item_bytes) throw std::bad_alloc();
  const std::size_t whole =
      (count * item_bytes + kLargePageBytes - 1) / kLargePageBytes * kLargePageBytes;
  void* const memory = std::aligned_alloc(kLargePageBytes, whole);
  if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  ::madvise(memory, whole, MADV_HUGEPAGE);
#endif
  return memory;
}

}  // namespace glintmark
