// The binomial draw of both methods (kernels/glint/binomial_template.clh): few and many trials, and
// all branches mixed in every vector.
#include <fmt/format.h>

#include <random>

#include "bench/device_bench.h"
#include "host/harness/binomial_cases.h"
#include "host/harness/probes.h"

namespace glintmark::bench {
namespace {

// Draws whose trials and probability are one of `cases` each, at random.
void draw(benchmark::State& state, GlintMethod method, const std::vector<BinomialCase>& cases,
          int lanes) {
  std::mt19937 random(1);
  std::vector<std::uint32_t> bits(kBinomialDraws);
  std::vector<float> n(kBinomialDraws), p(kBinomialDraws);
  for (std::size_t i = 0; i < kBinomialDraws; ++i) {
    const BinomialCase& c = cases[random() % cases.size()];
    bits[i] = static_cast<std::uint32_t>(random());
    n[i] = binomialTrials(c, random);
    p[i] = static_cast<float>(c.p);
  }
  timeKernel(state, "probeBinomial", kBinomialDraws, "draw",
             [&] { probeBinomial(deviceBench(), bits, n, p, method, lanes); });
}

void registerAll() {
  for (const auto& [name, method] :
       {std::pair("zk16", GlintMethod::kZk16), std::pair("exact", GlintMethod::kExact)}) {
    const auto add = [&, name = name, method = method](const std::string& what,
                                                       const std::vector<BinomialCase>& cases) {
      registerLanes(fmt::format("binomial/{}/{}", name, what),
                    [method, cases](benchmark::State& state, int lanes) {
                      draw(state, method, cases, lanes);
                    });
    };
    add("n:7_p:0.3", {{7, 0.3}});
    add("n:1e5_p:1e-4", {{1e5, 1e-4}});
    add("n:1e7_p:0.3", {{1e7, 0.3}});
    add("mixed", binomialGrid());
  }
}

}  // namespace
}  // namespace glintmark::bench

int main(int argc, char** argv) {
  return glintmark::bench::runDeviceBenchmarks(argc, argv, glintmark::bench::registerAll);
}
