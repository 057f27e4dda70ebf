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

void make(benchmark::State& state, GlintMethod method, float stretch, int lanes) {
  GlintMaterial glints{};
  glints.gamma = {stretch, 1};
  glints.finest_level = -30;
  std::vector<reference::PixelFootprint> footprints;
  for (const HandMadePixel& pixel : randomPixels(kPixels, {1e-4, 1e-2, 20}))
    footprints.push_back(pixel.footprint);
  timeKernel(state, "probeFootprint", kPixels, "px",
             [&] { probeFootprints(deviceBench(), footprints, glints, method, kKa, lanes); });
}

void registerAll() {
  for (const auto& [name, method] :
       {std::pair("zk16", GlintMethod::kZk16), std::pair("exact", GlintMethod::kExact)})
    for (const float stretch : {1.0f, 0.25f})
      registerLanes(fmt::format("footprint/{}/stretch:{}", name, stretch),
                    [method = method, stretch](benchmark::State& state, int lanes) {
                      make(state, method, stretch, lanes);
                    });
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
