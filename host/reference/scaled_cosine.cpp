#include "host/reference/scaled_cosine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glintmark::reference {
namespace {

constexpr double kShortestMean = 2.0 / 3.0;

// atanh(k) / k - 1 = k^2/3 + k^4/5 + ..., divided by k^2; for k^2 < 0 the same with atan.
double arcSeries(double k_sq) {
  if (std::abs(k_sq) < 0.05) {
    double sum = 0, power = 1;
    for (int n = 3; n < 41; n += 2, power *= k_sq) sum += power / n;
    return sum;
  }
  const double k = std::sqrt(std::abs(k_sq));
  return ((k_sq > 0 ? std::atanh(k) : std::atan(k)) / k - 1) / k_sq;
}

}  // namespace

double scaledCosineDensity(double alpha, double cosine) {
  if (cosine <= 0) return 0;
  const double alpha_sq = alpha * alpha;
  const double q = 1 - cosine * cosine + alpha_sq * cosine * cosine;
  return alpha_sq * cosine / (std::numbers::pi * q * q);
}

double meanResultantLength(double alpha) {
  // 2 a^2 int_0^1 c^2 / (1 - k^2 c^2)^2 dc, k^2 = 1 - a^2, is (1 - a^2 atanh(k) / k) / k^2.
  if (alpha <= 0) return 1;
  return 1 - alpha * alpha * arcSeries(1 - alpha * alpha);
}

double alphaOfMeanLength(double length) {
  if (!(length > kShortestMean)) return 1;
  if (length >= 1) return 0;
  double low = 0, high = 1;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (meanResultantLength(middle) > length ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double tao21MesoAlpha(double length) {
  const double b = std::clamp(length, kShortestMean, 1.0);
  const double numerator = (((1.629 * b + 17.05) * b - 18.96) * b - 23.37) * b + 23.65;
  const double denominator = ((b - 28.07) * b + 31.1) * b - 3.545;
  return std::clamp(numerator / denominator, 0.0, 1.0);
}

double tao21OverallAlpha(double alpha_mi, double alpha_me) {
  return std::clamp(
      0.07 * alpha_mi * alpha_mi + 0.94 * alpha_mi + alpha_me - 0.83 * alpha_mi * alpha_me, 0.0,
      1.0);
}

}  // namespace glintmark::reference
