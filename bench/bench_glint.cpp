// The glint loop of the shading kernel over random footprints, by cell and by pixel; aspects of the
// footprints from squares to the limit of cells.
#include <fmt/format.h>

#include <numeric>

#include "bench/device_bench.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"

namespace glintmark::bench {
namespace {

constexpr int kPixels = 1 << 15;

void shade(benchmark::State& state, GlintMethod method, double most_aspect, int lanes) {
  HandMadeFrame frame;
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.03f, 0.03f}, 1e7f);
  frame.pixels = randomPixels(kPixels, {1e-4, 1e-2, most_aspect});
  frame.lights = {coneLight({-0.3, 0.2, 0.9})};
  setRandomRays(frame);
  KernelConfig config;
  config.width = lanes;
  config.method = method;
  config.size_variation = false;
  config.count_cells = true;
  const ShadedPixels counted = shadePixels(deviceBench(), frame, config);
  const double cells = std::accumulate(counted.cells.begin(), counted.cells.end(), 0.0);
  config.count_cells = false;  // counting is off while the clock runs
  timeKernel(state, "shade", cells, "cell", [&] { shadePixels(deviceBench(), frame, config); });
  state.counters["cells/px"] = cells / kPixels;
}

void registerAll() {
  for (const auto& [name, method] :
       {std::pair("zk16", GlintMethod::kZk16), std::pair("exact", GlintMethod::kExact)})
    for (const int aspect : {1, 4, 16, 64})
      registerLanes(fmt::format("glint/{}/aspect:{}", name, aspect),
                    [method = method, aspect](benchmark::State& state, int lanes) {
                      shade(state, method, aspect, lanes);
                    });
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
