#include "host/core/free_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

std::uint64_t numberIn(const char* file) {
  std::ifstream stream(file);
  std::uint64_t value = 0;
  return stream >> value ? value : kUnknown;
}

std::uint64_t systemBytes() {
  std::ifstream stream("/proc/meminfo");
  for (std::string key, unit; stream >> key;) {
    std::uint64_t kilobytes = 0;
    if (key == "MemAvailable:" && stream >> kilobytes) return kilobytes * 1024;
    std::getline(stream, unit);
  }
  return kUnknown;
}

std::uint64_t controlGroupBytes() {
  const std::uint64_t most = numberIn("/sys/fs/cgroup/memory.max");
  const std::uint64_t used = numberIn("/sys/fs/cgroup/memory.current");
  if (most == kUnknown || used == kUnknown) return kUnknown;
  return most - std::min(used, most);
}

std::uint64_t addressSpaceBytes() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnknown;
  const std::uint64_t pages = numberIn("/proc/self/statm");
  if (pages == kUnknown) return kUnknown;
  const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur - std::min<std::uint64_t>(used, limit.rlim_cur);
}

}  // namespace

std::uint64_t freeMemoryBytes() {
  const std::uint64_t least = std::min({systemBytes(), controlGroupBytes(), addressSpaceBytes()});
  return least == kUnknown ? 0 : least;
}

void requireMemory(std::uint64_t bytes, const std::string& what) {
  const std::uint64_t free_bytes = freeMemoryBytes();
  if (free_bytes == 0 || bytes <= free_bytes) return;
  throw Error(fmt::format("{} needs about {:.1f} GB of memory, but {:.1f} GB are free", what,
                          static_cast<double>(bytes) * 1e-9,
                          static_cast<double>(free_bytes) * 1e-9));
}

}  // namespace glintmark
