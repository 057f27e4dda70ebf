#include "host/reference/binomial.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace glintmark::reference {
namespace {

namespace policies = boost::math::policies;
using RoundUp = policies::policy<policies::discrete_quantile<policies::integer_round_up>>;
using Binomial = boost::math::binomial_distribution<double, RoundUp>;

constexpr std::int64_t kLastTerm = 16;

// [ZK16] Sect. 4.3, the tail after i = kLastTerm, for u <= P(K > i). There U runs with k and
// here against it: (U - P(K <= i)) / (1 - P(K <= i)) = 1 - u / P(K > i).
double tailQuantile(double u, double upper, std::int64_t count, double p) {
  const double i = kLastTerm;
  const double c = 1.0 - std::pow(p, static_cast<double>(count) - i - 1.0);
  const double fraction = 1.0 - u / upper;
  const double k = i + 1.0 + std::log(1.0 - c * fraction) / std::log(p);
  return std::min(k, static_cast<double>(count));
}

// How one method draws at p <= 1/2.
struct DrawRule {
  double most_mean = 0;       // above it, the Cornish-Fisher expansion alone
  bool second_order = false;  // of that expansion
  bool tail = false;          // exponential beyond P(K = kLastTerm)
};
constexpr DrawRule kZk16 = {5, false, true}, kExact = {32, true, false};
constexpr double kBlendFrom = 0.75;  // of most_mean: there the expansion begins to take over

// Real numbers whose floor is the quantile.
double expansion(double u, double n, double p, bool second_order) {
  const double z = quantile(complement(boost::math::normal(), std::min(u, 1.0 - 1e-12)));
  const double variance = n * p * (1.0 - p), sigma = std::sqrt(variance);
  const double skewness = (1.0 - 2.0 * p) / sigma;
  double w = z + skewness * (z * z - 1.0) / 6.0;
  if (second_order) {
    const double kurtosis = (1.0 - 6.0 * p * (1.0 - p)) / variance;  // in excess of 3
    w += kurtosis * (z * z * z - 3.0 * z) / 24.0;
    w -= skewness * skewness * (2.0 * z * z * z - 5.0 * z) / 36.0;
  }
  return n * p + sigma * w + 0.5;
}

double summed(double u, std::int64_t count, double p, const DrawRule& rule) {
  const Binomial distribution(static_cast<double>(count), p);
  const auto upper = [&](std::int64_t j) {
    if (j < 0) return 1.0;
    return j >= count ? 0.0 : cdf(complement(distribution, static_cast<double>(j)));
  };
  if (rule.tail && count > kLastTerm && u <= upper(kLastTerm))
    return tailQuantile(u, upper(kLastTerm), count, p);
  const std::int64_t k = upperQuantile(u, count, p);
  const double part = (upper(k - 1) - u) / (upper(k - 1) - upper(k));
  return static_cast<double>(k) + std::clamp(part, 0.0, 0.999);
}

std::int64_t draw(double u, std::int64_t count, double p, const DrawRule& rule) {
  if (p > 0.5) return count - draw(1.0 - u, count, 1.0 - p, rule);
  if (count <= 0 || p <= 0) return 0;
  const double n = static_cast<double>(count), mean = n * p, from = kBlendFrom * rule.most_mean;
  const double t = std::clamp((mean - from) / (rule.most_mean - from), 0.0, 1.0);
  double x = t < 1 ? (1 - t) * summed(u, count, p, rule) : 0;
  if (t > 0) x += t * expansion(u, n, p, rule.second_order);
  return static_cast<std::int64_t>(std::clamp(std::floor(x), 0.0, n));
}

}  // namespace

std::int64_t upperQuantile(double u, std::int64_t count, double p) {
  if (count <= 0 || p <= 0) return 0;
  if (p >= 1) return count;
  if (u >= 1) return 0;
  const Binomial distribution(static_cast<double>(count), p);
  // The library treats quantiles below P(K = 0) as 0 and is otherwise right; small counts are
  // checked here so that the result is the definition whatever its root finder does.
  auto k = static_cast<std::int64_t>(quantile(complement(distribution, u)));
  k = std::clamp<std::int64_t>(k, 0, count);
  const auto upper = [&](std::int64_t j) {
    return j >= count ? 0.0 : cdf(complement(distribution, static_cast<double>(j)));
  };
  while (k > 0 && upper(k - 1) <= u) --k;
  while (upper(k) > u) ++k;
  return k;
}

std::int64_t drawExact(double u, std::int64_t count, double p) {
  return draw(u, count, p, kExact);
}

std::int64_t drawZk16(double u, std::int64_t count, double p, double limits) {
  DrawRule rule = kZk16;
  rule.most_mean *= limits;
  return draw(u, count, p, rule);
}

}  // namespace glintmark::reference
