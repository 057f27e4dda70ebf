#include "host/harness/binomial_cases.h"

#include <algorithm>
#include <cmath>

#include "host/harness/probes.h"

namespace glintmark {

std::vector<BinomialCase> binomialGrid() {
  std::vector<BinomialCase> cases;
  for (const double n : {0.0, 0.3, 1.0, 2.0, 7.0, 16.0, 40.0, 1e3, 1e5, 1e7, 1e9})
    for (const double p : {1e-9, 1e-7, 1e-4, 0.01, 0.3, 0.5, 0.7, 0.99, 1.0 - 1e-4, 1.0 - 1e-7})
      cases.push_back({n, static_cast<float>(p)});
  return cases;
}

float binomialTrials(const BinomialCase& c, std::mt19937& random) {
  const double whole = std::floor(c.n);
  const bool more = std::uniform_real_distribution<double>()(random) < c.n - whole;
  return static_cast<float>(whole + (more ? 1 : 0));
}

std::vector<float> binomialDraws(KernelBench& bench, const BinomialCase& c, GlintMethod method,
                                 bool stratified, int lanes) {
  std::mt19937 random(11);
  std::vector<std::uint32_t> bits(kBinomialDraws);
  std::vector<float> n(kBinomialDraws);
  const std::vector<float> p(kBinomialDraws, static_cast<float>(c.p));
  for (std::size_t i = 0; i < kBinomialDraws; ++i) {
    constexpr std::size_t kStratum = (std::size_t{1} << 32) / kBinomialDraws;
    bits[i] = stratified ? static_cast<std::uint32_t>(i * kStratum + kStratum / 2)
                         : static_cast<std::uint32_t>(random());
    n[i] = binomialTrials(c, random);
  }
  return probeBinomial(bench, bits, n, p, method, lanes);
}

double floatSpacing(double x) {
  return std::ldexp(1.0, std::ilogb(std::max(x, 1.0)) - 23);
}

}  // namespace glintmark
