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

constexpr double kMostExactMeanZk16 = 5;  // method zk16
constexpr std::int64_t kExactTerms = 16;

// [ZK16] Sect. 4.3, the tail after i = kExactTerms - 1, for u <= P(K > i). There U runs with k and
// here against it: (U - P(K <= i)) / (1 - P(K <= i)) = 1 - u / P(K > i).
std::int64_t drawTail(double u, double upper, std::int64_t count, double p) {
  const double i = kExactTerms - 1;
  const double c = 1.0 - std::pow(p, static_cast<double>(count) - i - 1.0);
  const double fraction = 1.0 - u / upper;
  const double k = i + 1.0 + std::floor(std::log(1.0 - c * fraction) / std::log(p));
  return std::min(static_cast<std::int64_t>(k), count);
}

std::int64_t drawNormal(double u, std::int64_t count, double p) {
  const double n = static_cast<double>(count);
  const double z = quantile(complement(boost::math::normal(), std::min(u, 1.0 - 1e-12)));
  const double k = std::floor(n * p + std::sqrt(n * p * (1.0 - p)) * z + 0.5);
  return static_cast<std::int64_t>(std::clamp(k, 0.0, n));
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
  return p <= 0.5 ? upperQuantile(u, count, p) : count - upperQuantile(u, count, 1.0 - p);
}

std::int64_t drawZk16(double u, std::int64_t count, double p) {
  if (p > 0.5) return count - drawZk16(u, count, 1.0 - p);
  if (count <= 0 || p <= 0) return 0;
  if (static_cast<double>(count) * p > kMostExactMeanZk16) return drawNormal(u, count, p);
  if (count > kExactTerms - 1) {
    const Binomial distribution(static_cast<double>(count), p);
    const double upper = cdf(complement(distribution, static_cast<double>(kExactTerms - 1)));
    if (u <= upper) return drawTail(u, upper, count, p);
  }
  return upperQuantile(u, count, p);
}

}  // namespace glintmark::reference
