// Filtering mixtures of normals along footprints (kernels/normals/texture_sum_template.clh): lobes
// of a texel, and most probes along the footprint.
#include <fmt/format.h>

#include "bench/device_bench.h"
#include "host/harness/texture_harness.h"

namespace glintmark::bench {
namespace {

constexpr std::size_t kPixels = 1 << 14;
constexpr int kTexels = 256;  // per side: 4 MB of four lobes, beyond the second-level cache

void fetch(benchmark::State& state, int lobes, int most_probes, int lanes) {
  const TestTexture texture = randomTexture(kTexels, kTexels, lobes, 7);
  const std::vector<TexturePixel> pixels = randomFootprints(kPixels, 11);
  double probes = 0;
  for (const FetchedTexel& fetched :
       fetchPixels(deviceBench(), texture, lobes, pixels, most_probes, true, lanes))
    probes += fetched.count;
  timeKernel(state, "probeTexture", kPixels, "px",
             [&] { fetchPixels(deviceBench(), texture, lobes, pixels, most_probes, true, lanes); });
  state.counters["probes/px"] = probes / static_cast<double>(kPixels);
}

void registerAll() {
  const auto add = [](int lobes, int most_probes) {
    registerLanes(fmt::format("gmmFilter/lobes:{}/probes:{}", lobes, most_probes),
                  [lobes, most_probes](benchmark::State& state, int lanes) {
                    fetch(state, lobes, most_probes, lanes);
                  });
  };
  for (const int lobes : {1, 2, 4, 8}) add(lobes, 16);
  for (const int most_probes : {1, 4}) add(4, most_probes);
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
