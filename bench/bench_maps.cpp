// Normal maps on all threads of the host: generating one, and the mip chain of its means.
#include "bench/device_bench.h"
#include "host/filter/normal_map_generators.h"
#include "host/filter/normal_moments.h"

namespace glintmark::bench {
namespace {

void perTexel(benchmark::State& state, int size_px) {
  state.counters["texels/s"] = benchmark::Counter(static_cast<double>(size_px) * size_px,
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void generate(benchmark::State& state) {
  const std::string kind = normalMapGenerators()[static_cast<std::size_t>(state.range(0))];
  const auto size_px = static_cast<int>(state.range(1));
  state.SetLabel(kind);
  for (auto _ : state) benchmark::DoNotOptimize(generateNormalMap({kind, size_px}));
  perTexel(state, size_px);
}
BENCHMARK(generate)
    ->ArgNames({"kind", "size"})
    ->ArgsProduct({{0, 1, 2, 3, 4, 5}, {512}})
    ->Args({1, 4096})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void means(benchmark::State& state) {
  const auto size_px = static_cast<int>(state.range(0));
  const NormalMap map = generateNormalMap({"disk", size_px});
  for (auto _ : state) benchmark::DoNotOptimize(meanNormals(map, false));
  perTexel(state, size_px);
}
BENCHMARK(means)
    ->ArgName("size")
    ->Arg(512)
    ->Arg(4096)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runHostBenchmarks(argc, argv, [] {});
}
