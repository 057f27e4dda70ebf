// The binomial sampler's distribution; its quantiles are checked by host/verify.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "host/harness/binomial_cases.h"
#include "tests/print_names.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

constexpr double kBinomialSignificance = 1e-5;  // 100 cases with fixed seeds
constexpr std::size_t kDraws = kBinomialDraws;
constexpr int kLanes = 16;

class Binomial : public testing::TestWithParam<GlintMethod> {};

TEST_P(Binomial, ChiSquare) {
  for (const BinomialCase& c : binomialGrid()) {
    if (c.n < 1) continue;
    const double mean = c.n * c.p, spread = mean * (1 - c.p);
    if (spread < 1e-3) continue;
    // Where zk16 goes over to a normal distribution by design, only moments are the binomial's.
    if (GetParam() == GlintMethod::kZk16 && c.n * std::min(c.p, 1 - c.p) > 3.75) continue;
    if (spread > 1e5 || floatSpacing(mean) > 1) continue;  // a float cannot tell classes apart
    const boost::math::binomial distribution(c.n, c.p);
    // Classes of at least 40 expected draws.
    std::map<std::int64_t, double> counts;
    for (const float k : binomialDraws(testBench(), c, GetParam(), false, kLanes))
      ++counts[static_cast<std::int64_t>(k)];
    const double sigma = std::sqrt(spread);
    const auto first = static_cast<std::int64_t>(std::max(0.0, std::floor(mean - 8 * sigma - 8)));
    const auto last = static_cast<std::int64_t>(std::min(c.n, std::ceil(mean + 8 * sigma + 8)));
    double chi = 0, expected = 0, observed = 0, total_expected = 0;
    int classes = 0;
    for (std::int64_t k = first; k <= last; ++k) {
      expected += kDraws * pdf(distribution, static_cast<double>(k));
      observed += counts[k];
      if (expected < 40 && k < last) continue;
      if (expected >= 5) {
        chi += (observed - expected) * (observed - expected) / expected;
        ++classes;
      }
      total_expected += expected;
      expected = observed = 0;
    }
    EXPECT_NEAR(total_expected, kDraws, 1e-3 * kDraws);
    if (classes < 2) continue;
    const double p_value = cdf(complement(boost::math::chi_squared(classes - 1), chi));
    EXPECT_GT(p_value, kBinomialSignificance)
        << c.n << " " << c.p << " chi2 " << chi << " of " << classes;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Binomial,
                         testing::Values(GlintMethod::kZk16, GlintMethod::kExact),
                         [](const auto& method) {
                           return method.param == GlintMethod::kZk16 ? "zk16" : "exact";
                         });

}  // namespace
}  // namespace glintmark
