// Seeds of cells and their random numbers (kernels/glint/hash.clh), over arrays in the caches.
#include <random>

#include "bench/device_bench.h"
#include "host/harness/probes.h"

namespace glintmark::bench {
namespace {

constexpr std::size_t kCount = 1 << 16;

template <typename T>
std::vector<T> randomWords() {
  std::mt19937 random(1);
  std::vector<T> words(kCount);
  for (T& word : words) word = static_cast<T>(random());
  return words;
}

void registerAll() {
  registerLanes("cellAndPairSeed", [](benchmark::State& state, int lanes) {
    const auto cells = randomWords<std::int32_t>();
    timeKernel(state, "probeHash", kCount, "seed",
               [&] { probeHash(deviceBench(), cells, cells, cells, cells, lanes); });
  });
  registerLanes("uniformAndGauss", [](benchmark::State& state, int lanes) {
    const auto bits = randomWords<std::uint32_t>();
    timeKernel(state, "probeRandom", kCount, "draw",
               [&] { probeRandom(deviceBench(), bits, lanes); });
  });
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
