// Fitting mixtures of normals on one thread of the host: the E-step alone, and whole chains over
// number of lobes, size of the map, and order of the texels.
#include <cmath>

#include "bench/device_bench.h"
#include "host/filter/normal_map_generators.h"
#include "host/mixture/mixture_em.h"

namespace glintmark::bench {
namespace {

void fit(benchmark::State& state, const MixtureOptions& options, int size_px) {
  const NormalMap map = generateNormalMap({"disk", size_px});
  for (auto _ : state) benchmark::DoNotOptimize(fitNormalMixtures(map, options));
  state.counters["texels/s"] = benchmark::Counter(static_cast<double>(size_px) * size_px,
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void fitLobes(benchmark::State& state) {
  MixtureOptions options;
  options.lobes = static_cast<int>(state.range(0));
  options.threads = 1;
  fit(state, options, static_cast<int>(state.range(1)));
}
BENCHMARK(fitLobes)
    ->ArgNames({"lobes", "size"})
    ->Args({1, 128})
    ->Args({2, 128})
    ->Args({4, 128})
    ->Args({8, 128})
    ->Args({4, 256})
    ->Args({4, 512})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void fitOrder(benchmark::State& state) {
  MixtureOptions options;
  options.order = static_cast<MixtureOrder>(state.range(0));
  options.threads = 1;
  state.SetLabel(mixtureOrderName(options.order));
  fit(state, options, 128);
}
BENCHMARK(fitOrder)
    ->ArgName("order")
    ->DenseRange(0, static_cast<int>(MixtureOrder::kIndependent))
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

// A block of sixteen texels with `normals` each; lobes spread over the disk.
void expectation(benchmark::State& state) {
  const auto lobes = static_cast<int>(state.range(0));
  const auto normals = static_cast<std::size_t>(state.range(1));
  std::vector<float> x, y;
  for (std::size_t i = 0; i < normals * kBlockTexels; ++i) {
    x.push_back(0.5f * std::sin(0.7f * static_cast<float>(i)));
    y.push_back(0.5f * std::cos(1.1f * static_cast<float>(i)));
  }
  const std::vector<float> weight(x.size(), 1.0f);
  MixtureBlock block{};
  for (int lobe = 0; lobe < lobes; ++lobe)
    for (int lane = 0; lane < kBlockTexels; ++lane) {
      const float turn = 6.28f * static_cast<float>(lobe) / static_cast<float>(lobes);
      block.weight[lobe][lane] = 1.0f / static_cast<float>(lobes);
      block.mean_x[lobe][lane] = 0.3f * std::cos(turn);
      block.mean_y[lobe][lane] = 0.3f * std::sin(turn);
      block.variance[lobe][lane] = 0.02f;
    }
  for (auto _ : state) {
    expectBlock(block, lobes, {x.data(), y.data(), weight.data(), normals}, false);
    benchmark::DoNotOptimize(block);
  }
  state.counters["lobe_normals/s"] = benchmark::Counter(
      static_cast<double>(x.size()) * lobes, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(expectation)
    ->ArgNames({"lobes", "normals"})
    ->Args({1, 64})
    ->Args({4, 4})
    ->Args({4, 64})
    ->Args({8, 64});

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runHostBenchmarks(argc, argv, [] {});
}
