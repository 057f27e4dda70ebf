#include "host/harness/kernel_bench.h"

namespace glintmark {

Kernel probeKernel(KernelBench& bench, const std::string& file, const std::string& name,
                   const std::string& switches) {
  return bench.cache.getWithOptions(file, switches).kernel(name);
}

std::size_t paddedCount(std::size_t n) {
  constexpr std::size_t kMostLanes = 16;
  return (n + kMostLanes - 1) / kMostLanes * kMostLanes;
}

}  // namespace glintmark
