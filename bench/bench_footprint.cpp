// Footprints of pixels in the grids of cells (kernels/glint/footprint.clh): both methods, stretched
// or not.
#include <fmt/format.h>

#include "bench/device_bench.h"
#include "host/harness/probes.h"
#include "host/harness/random_pixels.h"

namespace glintmark::bench {
namespace {

constexpr int kPixels = 1 << 16;
constexpr int kKa = 16;

void make(benchmark::State& state, GlintMethod method, const glm::dvec2& stretch, int lanes) {
  std::vector<reference::PixelFootprint> footprints;
  for (const HandMadePixel& pixel : randomPixels(kPixels, {1e-4, 1e-2, 20}))
    footprints.push_back(pixel.footprint);
  timeKernel(state, "probeFootprint", kPixels, "px",
             [&] { probeFootprints(deviceBench(), footprints, stretch, method, kKa, lanes); });
}

void registerAll() {
  for (const auto& [name, method] :
       {std::pair("zk16", GlintMethod::kZk16), std::pair("exact", GlintMethod::kExact)})
    for (const double stretch : {1.0, 0.25})
      registerLanes(fmt::format("footprint/{}/stretch:{}", name, stretch),
                    [method = method, stretch](benchmark::State& state, int lanes) {
                      make(state, method, {stretch, 1}, lanes);
                    });
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
