// Filtering mixtures of normals along footprints (kernels/normals/texture_sum_template.clh): lobes
// of a texel, most probes along the footprint, most rows of them across.
#include <fmt/format.h>

#include "bench/device_bench.h"
#include "host/harness/texture_harness.h"

namespace glintmark::bench {
namespace {

constexpr std::size_t kPixels = 1 << 14;
constexpr int kTexels = 256;  // per side: 4 MB of four lobes, beyond the second-level cache

void fetch(benchmark::State& state, int lobes, const reference::ProbeLimits& most, int lanes) {
  const TestTexture texture = randomTexture(kTexels, kTexels, lobes, 7);
  const std::vector<TexturePixel> pixels = randomFootprints(kPixels, 11);
  double probes = 0;
  for (const FetchedTexel& fetched :
       fetchPixels(deviceBench(), texture, lobes, pixels, most, true, lanes))
    probes += fetched.count * fetched.rows;
  timeKernel(state, "probeTexture", kPixels, "px",
             [&] { fetchPixels(deviceBench(), texture, lobes, pixels, most, true, lanes); });
  state.counters["probes/px"] = probes / static_cast<double>(kPixels);
}

void registerAll() {
  const auto add = [](int lobes, const reference::ProbeLimits& most) {
    registerLanes(
        fmt::format("gmmFilter/lobes:{}/probes:{}/rows:{}", lobes, most.count, most.rows),
        [lobes, most](benchmark::State& state, int lanes) { fetch(state, lobes, most, lanes); });
  };
  for (const int lobes : {1, 2, 4, 8}) add(lobes, {16, 1});
  for (const int most_probes : {1, 4}) add(4, {most_probes, 1});
  for (const int rows : {2, 4}) add(4, {16, rows});
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
