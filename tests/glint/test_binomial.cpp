// The binomial sampler against Boost.Math.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "host/reference/binomial.h"
#include "tests/glint/pixel_harness.h"
#include "tests/glint/probes.h"

namespace glintmark {
namespace {

constexpr std::size_t kDraws = 1 << 16;
constexpr double kSignificance = 1e-5;  // 100 cases with fixed seeds

struct BinomialCase {
  double n, p;
};

std::vector<BinomialCase> grid() {
  std::vector<BinomialCase> cases;
  for (const double n : {0.0, 0.3, 1.0, 2.0, 7.0, 16.0, 40.0, 1e3, 1e5, 1e7, 1e9})
    for (const double p : {1e-9, 1e-7, 1e-4, 0.01, 0.3, 0.5, 0.7, 0.99, 1.0 - 1e-4, 1.0 - 1e-7})
      cases.push_back({n, static_cast<float>(p)});
  return cases;
}

// Distance between floats around x: counts beyond 2^24 are held to that.
double floatSpacing(double x) {
  return std::ldexp(1.0, std::ilogb(std::max(x, 1.0)) - 23);
}

// Number of trials of draw i: a fraction is rounded up or down at random, as cells do.
float trialsOf(const BinomialCase& c, std::mt19937& random) {
  const double whole = std::floor(c.n);
  const bool more = std::uniform_real_distribution<double>()(random) < c.n - whole;
  return static_cast<float>(whole + (more ? 1 : 0));
}

std::vector<float> draws(const BinomialCase& c, GlintMethod method, bool stratified) {
  std::mt19937 random(11);
  std::vector<float> u(kDraws), n(kDraws), p(kDraws, static_cast<float>(c.p));
  for (std::size_t i = 0; i < kDraws; ++i) {
    const double uniform = stratified ? (static_cast<double>(i) + 0.5) / kDraws
                                      : (static_cast<double>(random()) + 0.5) * 0x1p-32;
    u[i] = static_cast<float>(uniform);
    n[i] = trialsOf(c, random);
  }
  return probeBinomial(u, n, p, method, 16);
}

class Binomial : public testing::TestWithParam<GlintMethod> {};

TEST_P(Binomial, MeanAndVariance) {
  for (const BinomialCase& c : grid()) {
    const std::vector<float> k = draws(c, GetParam(), true);
    double mean = 0, variance = 0;
    for (const float x : k) {
      ASSERT_TRUE(x >= 0 && x <= std::ceil(c.n)) << c.n << " " << c.p << " " << x;
      mean += x / static_cast<double>(kDraws);
    }
    for (const float x : k) variance += (x - mean) * (x - mean) / kDraws;
    // 0.3 trials: one with probability 0.3.
    const double want_mean = c.n * c.p;
    const double want_variance = c.n < 1 ? want_mean * (1 - want_mean) : want_mean * (1 - c.p);
    const double sigma = std::sqrt(want_variance);
    // Stratified uniforms leave less than 0.01 sigma of the mean and 2 % of the variance open (for
    // 0.3 trials, whose rounding is random, and rare events the standard error counts); where k is
    // beyond 2^24, a float holds it to 6e-8.
    const double standard_error = 4 * sigma / std::sqrt(static_cast<double>(kDraws));
    EXPECT_NEAR(mean, want_mean, standard_error + 2e-7 * want_mean) << c.n << " " << c.p;
    if (want_variance > 0.01 && sigma > 100 * floatSpacing(want_mean)) {
      EXPECT_NEAR(variance / want_variance, 1.0, 0.025) << c.n << " " << c.p;
    }
  }
}

TEST_P(Binomial, ChiSquare) {
  for (const BinomialCase& c : grid()) {
    if (c.n < 1) continue;
    const double mean = c.n * c.p, spread = mean * (1 - c.p);
    if (spread < 1e-3) continue;
    // Where zk16 draws from a normal distribution by design, only moments are the binomial's.
    if (GetParam() == GlintMethod::kZk16 && c.n * std::min(c.p, 1 - c.p) > 5) continue;
    if (spread > 1e5 || floatSpacing(mean) > 1) continue;  // a float cannot tell classes apart
    const boost::math::binomial distribution(c.n, c.p);
    // Classes of at least 40 expected draws.
    std::map<std::int64_t, double> counts;
    for (const float k : draws(c, GetParam(), false)) ++counts[static_cast<std::int64_t>(k)];
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
    EXPECT_GT(p_value, kSignificance) << c.n << " " << c.p << " chi2 " << chi << " of " << classes;
  }
}

TEST_P(Binomial, SameBitsAtEveryWidth) {
  std::mt19937 random(12);
  std::vector<float> u, n, p;
  for (const BinomialCase& c : grid())
    for (int i = 0; i < 64; ++i) {
      u.push_back(static_cast<float>((static_cast<double>(random()) + 0.5) * 0x1p-32));
      n.push_back(trialsOf(c, random));
      p.push_back(static_cast<float>(c.p));
    }
  const auto one = probeBinomial(u, n, p, GetParam(), 1);
  for (const int width : {4, 8, 16}) {
    const auto wide = probeBinomial(u, n, p, GetParam(), width);
    EXPECT_EQ(one, wide) << "width " << width;
  }
}

TEST_P(Binomial, ExtremesAreFiniteAndInRange) {
  std::vector<float> u, n, p;
  for (const float a : {0x1p-33f, 1e-9f, 1e-4f, 0.5f, 0.9999999f, 1.0f})
    for (const float b : {0.f, 1.f, 2.f, 17.f, 1e4f, 1e9f, 0x1p30f})
      for (const float c : {0.f, 1e-38f, 1e-12f, 1e-9f, 0.5f, 0.50000006f, 0.99999994f, 1.f}) {
        u.push_back(a);
        n.push_back(b);
        p.push_back(c);
      }
  const auto k = probeBinomial(u, n, p, GetParam(), 16);
  for (std::size_t i = 0; i < k.size(); ++i) {
    EXPECT_TRUE(k[i] >= 0 && k[i] <= n[i]) << u[i] << " " << n[i] << " " << p[i] << ": " << k[i];
    EXPECT_EQ(k[i], std::floor(k[i]));
    if (p[i] == 0) {
      EXPECT_EQ(k[i], 0) << u[i] << " " << n[i];
    }
    if (p[i] == 1) {
      EXPECT_EQ(k[i], n[i]) << u[i];
    }
  }
}

std::int64_t referenceDraw(double u, double n, double p, GlintMethod method) {
  const auto count = static_cast<std::int64_t>(n);
  return method == GlintMethod::kExact ? reference::drawExact(u, count, p)
                                       : reference::drawZk16(u, count, p);
}

TEST_P(Binomial, QuantileAgreesWithBoost) {
  std::mt19937 random(13);
  std::vector<float> u, n, p;
  for (const BinomialCase& c : grid())
    for (int i = 0; i < 200; ++i) {
      u.push_back(static_cast<float>((static_cast<double>(random()) + 0.5) * 0x1p-32));
      n.push_back(static_cast<float>(std::floor(c.n)));
      p.push_back(static_cast<float>(c.p));
    }
  const auto k = probeBinomial(u, n, p, GetParam(), 16);
  const double summed_mean = GetParam() == GlintMethod::kExact ? 32 : 5;
  std::size_t summed = 0, different = 0;
  double worst_sigmas = 0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const auto want = static_cast<double>(referenceDraw(u[i], n[i], p[i], GetParam()));
    const double difference = std::abs(k[i] - want), sigma = std::sqrt(n[i] * p[i] * (1.0 - p[i]));
    if (n[i] * std::min<double>(p[i], 1.0 - p[i]) <= summed_mean) {
      ++summed;
      different += difference > floatSpacing(n[i]) / 2;
      ASSERT_LE(difference, 1 + floatSpacing(n[i])) << u[i] << " " << n[i] << " " << p[i];
    } else {
      // Rounding to whole numbers, single precision of n p, and what the expansion leaves.
      const double rounding = 1.01 + floatSpacing(n[i]) + 4e-7 * n[i] * p[i];
      worst_sigmas = std::max(worst_sigmas, std::max(difference - rounding, 0.0) / sigma);
    }
  }
  std::printf("summed draws that differ: %zu of %zu; others within 1 + %.2g sigma\n", different,
              summed, worst_sigmas);
  EXPECT_LE(static_cast<double>(different), 1e-3 * static_cast<double>(summed));
  EXPECT_LE(worst_sigmas, 0.01);
}

TEST_P(Binomial, DeepTailHasNoFireflies) {
  // Beyond u = 1e-7 of P(K > 0), sums in single precision cannot resolve u any more; but they must
  // not answer with more than the smallest of all uniforms stands for.
  constexpr float kLeastUniform = 0x1p-33f;
  std::vector<float> u, n, p;
  std::mt19937 random(14);
  for (const float count : {1.f, 3.f, 7.f, 12.f, 20.f, 100.f, 1e4f, 1e6f, 1e9f})
    for (const float mean : {1e-6f, 1e-3f, 0.05f, 0.5f, 1.f, 3.f, 4.9f, 10.f, 30.f})
      for (int i = 0; i < 64 && mean < 0.5f * count; ++i) {
        u.push_back(i == 0 ? kLeastUniform
                           : static_cast<float>(std::pow(10.0, -6 - 3.9 * random() * 0x1p-32)));
        n.push_back(count);
        p.push_back(mean / count);
      }
  const auto k = probeBinomial(u, n, p, GetParam(), 16);
  int fireflies = 0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const auto most = static_cast<double>(referenceDraw(kLeastUniform, n[i], p[i], GetParam()));
    if (k[i] <= most + 1) continue;
    if (++fireflies <= 5)
      ADD_FAILURE() << "u " << u[i] << " n " << n[i] << " p " << p[i] << ": " << k[i]
                    << " where the least u gives " << most;
  }
  EXPECT_EQ(fireflies, 0) << "of " << k.size();
}

INSTANTIATE_TEST_SUITE_P(Methods, Binomial,
                         testing::Values(GlintMethod::kZk16, GlintMethod::kExact),
                         [](const auto& method) {
                           return method.param == GlintMethod::kZk16 ? "zk16" : "exact";
                         });

}  // namespace
}  // namespace glintmark
