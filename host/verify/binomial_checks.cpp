// The binomial sampler against closed forms and Boost.Math.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "host/harness/binomial_cases.h"
#include "host/harness/probes.h"
#include "host/harness/tolerances.h"
#include "host/reference/binomial.h"
#include "host/reference/seeds.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

// Mean in standard errors, and the variance where a float can hold it.
Finding moments(const CheckContext& context, GlintMethod method) {
  Finding finding(kMeanStandardErrors);
  for (const BinomialCase& c : binomialGrid()) {
    const std::vector<float> k = binomialDraws(context.bench, c, method, true, context.lanes);
    double mean = 0, variance = 0;
    for (const float x : k) {
      finding.require(x >= 0 && x <= std::ceil(c.n),
                      fmt::format("{} successes of {} trials", x, c.n));
      mean += x / static_cast<double>(kBinomialDraws);
    }
    for (const float x : k) variance += (x - mean) * (x - mean) / kBinomialDraws;
    // 0.3 trials: one with probability 0.3.
    const double want_mean = c.n * c.p;
    const double want_variance = c.n < 1 ? want_mean * (1 - want_mean) : want_mean * (1 - c.p);
    const double sigma = std::sqrt(want_variance);
    // Where k is beyond 2^24, a float holds it to 6e-8.
    const double standard_error =
        sigma / std::sqrt(static_cast<double>(kBinomialDraws)) + 0.5e-7 * want_mean;
    finding.require(standard_error > 0 || mean == 0, "something comes of nothing");
    if (standard_error > 0) finding.add(std::abs(mean - want_mean) / standard_error);
    if (want_variance > 0.01 && sigma > 100 * floatSpacing(want_mean))
      finding.require(std::abs(variance / want_variance - 1) < kVarianceTolerance,
                      fmt::format("variance of {} trials of probability {} is {}, not {}", c.n, c.p,
                                  variance, want_variance));
  }
  return finding;
}

double referenceDraw(double u, double n, double p, GlintMethod method) {
  const auto count = static_cast<std::int64_t>(n);
  return static_cast<double>(method == GlintMethod::kExact ? reference::drawExact(u, count, p)
                                                           : reference::drawZk16(u, count, p));
}

// Summed draws are Boost.Math's quantile, others within what the normal expansion leaves.
Finding quantiles(const CheckContext& context, GlintMethod method) {
  std::mt19937 random(13);
  std::vector<std::uint32_t> bits;
  std::vector<float> n, p;
  for (const BinomialCase& c : binomialGrid())
    for (int i = 0; i < 200; ++i) {
      bits.push_back(static_cast<std::uint32_t>(random()));
      n.push_back(static_cast<float>(std::floor(c.n)));
      p.push_back(static_cast<float>(c.p));
    }
  const auto k = probeBinomial(context.bench, bits, n, p, method, context.lanes);
  const double summed_mean = method == GlintMethod::kExact ? 24 : 3.75;
  std::size_t summed = 0, different = 0;
  Finding finding(kFlippedDrawShare);
  for (std::size_t i = 0; i < k.size(); ++i) {
    const double u = reference::uniformOf(bits[i]);
    const double difference = std::abs(k[i] - referenceDraw(u, n[i], p[i], method));
    const double sigma = std::sqrt(n[i] * p[i] * (1.0 - p[i]));
    const auto where = [&] { return fmt::format("u {} n {} p {}: {}", u, n[i], p[i], k[i]); };
    if (n[i] * std::min<double>(p[i], 1.0 - p[i]) <= summed_mean) {
      ++summed;
      different += difference > floatSpacing(n[i]) / 2;
      if (difference > 1 + floatSpacing(n[i])) finding.require(false, where());
    } else {
      // Rounding to whole numbers, single precision of n p, and what the expansion leaves.
      const double rounding = 1.01 + floatSpacing(n[i]) + 4e-7 * n[i] * p[i];
      if (difference - rounding > kExpansionSigmas * sigma) finding.require(false, where());
    }
  }
  finding.add(static_cast<double>(different) / static_cast<double>(summed));
  return finding;
}

Finding extremeDraws(const CheckContext& context, GlintMethod method) {
  std::vector<std::uint32_t> bits;
  std::vector<float> n, p;
  for (const std::uint32_t a : {0u, 4u, 429497u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFE52u, ~0u})
    for (const float b : {0.f, 1.f, 2.f, 17.f, 1e4f, 1e9f, 0x1p30f})
      for (const float c : {0.f, 1e-38f, 1e-12f, 1e-9f, 0.5f, 0.50000006f, 0.99999994f, 1.f}) {
        bits.push_back(a);
        n.push_back(b);
        p.push_back(c);
      }
  const auto k = probeBinomial(context.bench, bits, n, p, method, context.lanes);
  double bad = 0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const bool in_range = k[i] >= 0 && k[i] <= n[i] && k[i] == std::floor(k[i]);
    bad += !in_range || (p[i] == 0 && k[i] != 0) || (p[i] == 1 && k[i] != n[i]);
  }
  Finding finding(0);
  finding.add(bad);
  return finding;
}

// Beyond u = 1e-7 of P(K > 0), sums in single precision cannot resolve u any more; but they must
// not answer with more than the smallest of all uniforms stands for.
Finding deepTail(const CheckContext& context, GlintMethod method) {
  constexpr double kLeastUniform = 0x1p-33;
  std::vector<std::uint32_t> bits;
  std::vector<float> n, p;
  std::mt19937 random(14);
  for (const float count : {1.f, 3.f, 7.f, 12.f, 20.f, 100.f, 1e4f, 1e6f, 1e9f})
    for (const float mean : {1e-6f, 1e-3f, 0.05f, 0.5f, 1.f, 3.f, 4.9f, 10.f, 30.f})
      for (int i = 0; i < 64 && mean < 0.5f * count; ++i) {
        const double u = std::pow(10.0, -6 - 3.9 * random() * 0x1p-32);
        bits.push_back(i == 0 ? 0 : static_cast<std::uint32_t>(u * 0x1p32));
        n.push_back(count);
        p.push_back(mean / count);
      }
  const auto k = probeBinomial(context.bench, bits, n, p, method, context.lanes);
  double fireflies = 0;
  for (std::size_t i = 0; i < k.size(); ++i)
    fireflies += k[i] > referenceDraw(kLeastUniform, n[i], p[i], method) + 1;
  Finding finding(0);
  finding.add(fireflies);
  return finding;
}

// Where the normal distribution stands for the binomial, one draw in ten thousand: the mean
// distance to Boost.Math's quantile, which rounding to whole numbers leaves alone.
Finding expandedTail(const CheckContext& context) {
  constexpr std::size_t kDraws = 4096;
  Finding finding(kExpandedTail);
  for (const double mean : {33.0, 45.0, 80.0, 300.0})
    for (const double probability : {1e-4, 0.05, 0.3})
      for (const bool upper : {true, false}) {
        std::vector<std::uint32_t> bits;
        for (std::size_t i = 0; i < kDraws; ++i) {
          const double u = 1e-5 * std::pow(30.0, (static_cast<double>(i) + 0.5) / kDraws);
          bits.push_back(static_cast<std::uint32_t>((upper ? u : 1 - u) * 0x1p32));
        }
        const float trials = std::round(static_cast<float>(mean / probability));
        const auto p = static_cast<float>(probability);
        const auto k =
            probeBinomial(context.bench, bits, std::vector<float>(kDraws, trials),
                          std::vector<float>(kDraws, p), GlintMethod::kExact, context.lanes);
        double difference = 0;
        for (std::size_t i = 0; i < kDraws; ++i)
          difference +=
              k[i] - static_cast<double>(reference::upperQuantile(
                         reference::uniformOf(bits[i]), static_cast<std::int64_t>(trials), p));
        finding.add(std::abs(difference / kDraws));
      }
  return finding;
}

// [ZK16] Sect. 4.3 with i terms: the exact distribution up to k = i, then the exponential tail.
double cappedDraw(double u, double n, double p, int i) {
  double term = std::pow(1 - p, n), above = 1 - term;  // P(K = 0), P(K > 0)
  for (int k = 0; k <= i; ++k) {
    if (above <= u) return k;
    if (k == i) break;
    term *= (n - k) / (k + 1) * p / (1 - p);
    above -= term;
  }
  const double cut = 1 - std::pow(p, n - i - 1);
  return i + 1 + std::floor(std::log(1 - cut * (1 - u / above)) / std::log(p));
}

// With few terms the tail holds many draws; after 16 it is out of reach.
Finding fewTerms(const CheckContext& context) {
  constexpr std::size_t kDraws = 8192;
  Finding finding(kFlippedDrawShare);
  for (const int terms : {2, 4, 8})
    for (const auto& [n, p] : {std::pair{12.f, 0.25f}, {40.f, 0.09f}, {1000.f, 0.003f}}) {
      std::vector<std::uint32_t> bits;
      for (std::size_t i = 0; i < kDraws; ++i)
        bits.push_back(
            static_cast<std::uint32_t>((static_cast<double>(i) + 0.5) / kDraws * 0x1p32));
      std::vector<float> k(kDraws);
      Buffer out(context.bench.device, kDraws * 4, BufferPurpose::kProbe, "draws");
      const std::vector<KernelArg> args = {probeData(context.bench, bits),
                                           probeData(context.bench, std::vector<float>(kDraws, n)),
                                           probeData(context.bench, std::vector<float>(kDraws, p)),
                                           out, static_cast<std::uint32_t>(kDraws)};
      probeKernel(
          context.bench, "probes/probe_binomial.cl", "probeBinomial",
          fmt::format("-D WIDTH={} -D BINOMIAL=3 -D BINOMIAL_TERMS={}", context.lanes, terms))
          .launch(args, kDraws / static_cast<std::size_t>(context.lanes), kLocalSize);
      out.read(k.data(), kDraws * 4);
      double different = 0, tail = 0;
      for (std::size_t i = 0; i < kDraws; ++i) {
        const double want = cappedDraw(reference::uniformOf(bits[i]), n, p, terms);
        different += k[i] != want;
        tail += want > terms;
      }
      finding.add(different / kDraws);
      finding.require(terms > 4 || tail > 50, "too few draws of the tail");
    }
  return finding;
}

Finding sameDraws(const CheckContext& context, GlintMethod method) {
  std::mt19937 random(12);
  std::vector<std::uint32_t> bits;
  std::vector<float> n, p;
  for (const BinomialCase& c : binomialGrid())
    for (int i = 0; i < 64; ++i) {
      bits.push_back(static_cast<std::uint32_t>(random()));
      n.push_back(binomialTrials(c, random));
      p.push_back(static_cast<float>(c.p));
    }
  const auto one = probeBinomial(context.bench, bits, n, p, method, 1),
             wide = probeBinomial(context.bench, bits, n, p, method, context.lanes);
  double different = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    different += std::bit_cast<std::uint32_t>(one[i]) != std::bit_cast<std::uint32_t>(wide[i]);
  Finding finding(0);
  finding.add(different);
  return finding;
}

}  // namespace

std::vector<Check> binomialChecks() {
  std::vector<Check> checks;
  for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact}) {
    const std::string group = method == GlintMethod::kZk16 ? "binomial/zk16_" : "binomial/exact_";
    const auto add = [&](const char* name, const char* measure,
                         Finding (*run)(const CheckContext&, GlintMethod)) {
      checks.push_back({group + name, measure, [run, method](const CheckContext& context) {
                          return run(context, method);
                        }});
    };
    add("moments", "standard errors of the mean", moments);
    add("quantile", "share of sums that differ from Boost.Math", quantiles);
    add("extremes", "draws out of range", extremeDraws);
    add("deep_tail", "draws beyond the least uniform's", deepTail);
    add("same_bits", "draws that differ from one lane's", sameDraws);
  }
  checks.push_back({"binomial/few_terms", "share of draws that differ", fewTerms});
  checks.push_back({"binomial/exact_tail", "mean distance from Boost.Math", expandedTail});
  return checks;
}

}  // namespace glintmark
