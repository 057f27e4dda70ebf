#include "host/core/free_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "host/core/control_group.h"
#include "host/core/error.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

// What a group may still take: files that it has cached can go.
double leastGroupMemory(const fs::path& root) {
  double bytes = INFINITY;
  const auto consider = [&](const fs::path& folder, const char* limit, const char* used,
                            const char* cached) {
    const auto most = readNumber(folder / limit), held = readNumber(folder / used);
    if (!most || !held) return;
    const double files = numberAfter(folder / "memory.stat", cached).value_or(0);
    bytes = std::min(bytes, std::max(0.0, *most - *held + files));
  };
  for (const fs::path& folder : groupFolders(root, ""))
    consider(folder, "memory.max", "memory.current", "inactive_file");
  for (const fs::path& folder : groupFolders(root, "memory"))
    consider(folder, "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file");
  return bytes;
}

double leastAddressSpace(const fs::path& root) {
  rlimit limit = {};
  const auto pages = readNumber(root / "proc/self/statm");
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || !pages)
    return INFINITY;
  const double used = *pages * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

}  // namespace

std::uint64_t freeMemoryBytes(const fs::path& root) {
  const auto free_kb = numberAfter(root / "proc/meminfo", "MemAvailable:");
  const double least = std::min(
      {free_kb ? *free_kb * 1024 : INFINITY, leastGroupMemory(root), leastAddressSpace(root)});
  return std::isfinite(least) ? static_cast<std::uint64_t>(least) : 0;
}

void requireMemory(std::uint64_t bytes, const std::string& what) {
  // Asking takes some twenty reads of /proc and of control groups, a tenth of a millisecond or
  // more.
  constexpr std::uint64_t kTooLittleToAsk = std::uint64_t{8} << 20;
  if (bytes < kTooLittleToAsk) return;
  const std::uint64_t free_bytes = freeMemoryBytes();
  if (free_bytes == 0 || bytes <= free_bytes) return;
  throw Error(fmt::format("{} needs about {:.1f} GB of memory, but {:.1f} GB are free", what,
                          static_cast<double>(bytes) * 1e-9,
                          static_cast<double>(free_bytes) * 1e-9));
}

}  // namespace glintmark
