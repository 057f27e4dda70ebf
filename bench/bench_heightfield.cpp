// Rays at random rough surfaces (kernels/scatter/heightfield.cl), all orders: three kinds of
// material, smooth to rough, steep to grazing.
#include <fmt/format.h>

#include "bench/device_bench.h"
#include "host/harness/pixel_harness.h"
#include "host/simulate/simulation.h"

namespace glintmark::bench {
namespace {

constexpr std::uint64_t kRays = 1 << 16;

void cast(benchmark::State& state, SimulationSettings settings, int lanes) {
  settings.rays = kRays;
  KernelBench& bench = deviceBench();
  Simulator simulator(bench.device, bench.cache, lanes);
  timeKernel(state, "traceRays", static_cast<double>(kRays), "ray",
             [&] { simulator.run(settings); });
}

void registerAll() {
  const auto add = [](const std::string& name, SurfaceKind kind, double alpha,
                      double incidence_deg) {
    SimulationSettings settings;
    settings.kind = kind;
    settings.alpha = glm::dvec2(alpha);
    settings.incidence_deg = incidence_deg;
    settings.index_k = kind == SurfaceKind::kMetal ? 3 : 0;
    registerLanes(fmt::format("rays/{}/alpha:{}/incidence:{}", name, alpha, incidence_deg),
                  [settings](benchmark::State& state, int lanes) { cast(state, settings, lanes); });
  };
  for (const double alpha : {0.1, 0.8}) add("diffuse", SurfaceKind::kDiffuse, alpha, 45);
  add("diffuse", SurfaceKind::kDiffuse, 0.8, 85);
  add("metal", SurfaceKind::kMetal, 0.8, 45);
  add("dielectric", SurfaceKind::kDielectric, 0.8, 45);
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
