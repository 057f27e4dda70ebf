// The kernels' own elementary functions: errors as stated in wide_math.clh, and the same bits at
// every lane count.
#include <gtest/gtest.h>

#include <bit>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/glint/pixel_harness.h"
#include "tests/glint/probes.h"

namespace glintmark {
namespace {

// As wide_math.clh states them.
constexpr double kExp2Error = 5e-7, kLog2Error = 2e-7, kReciprocalError = 2e-7;
constexpr double kRsqrtError = 3e-7, kQuantileError = 1.2e-6;

constexpr std::size_t kSamples = 1 << 16;

// kSamples floats from `low` to `high`, evenly spaced, or evenly in their logarithm.
std::vector<float> range(double low, double high, bool logarithmic) {
  std::vector<float> x(kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double t = static_cast<double>(i) / (kSamples - 1);
    x[i] = static_cast<float>(logarithmic ? low * std::pow(high / low, t) : low + (high - low) * t);
  }
  return x;
}

double worstError(const std::vector<float>& x, const std::vector<float>& y,
                  const std::function<double(double, double)>& error) {
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, error(x[i], y[i]));
  return worst;
}

double relative(double got, double want) {
  return std::abs(got - want) / std::abs(want);
}

TEST(WideMath, Exp2) {
  const auto x = range(-125.5, 126, false);
  EXPECT_LT(worstError(x, probeMath(MathFunction::kExp2, x, 16),
                       [](double a, double y) { return relative(y, std::exp2(a)); }),
            kExp2Error);
}

TEST(WideMath, Exp2IsClampedFromBelow) {
  for (const float y : probeMath(MathFunction::kExp2, {-127.f, -1e4f, -1e30f, -INFINITY}, 16))
    EXPECT_EQ(y, std::exp2(-126.f));
}

TEST(WideMath, Log2) {
  const auto check = [](const std::vector<float>& x) {
    return worstError(x, probeMath(MathFunction::kLog2, x, 16), [](double a, double y) {
      const double want = std::log2(a);
      const double half_ulp = std::abs(want) * 0x1p-24;
      return std::abs(y - want) - half_ulp;
    });
  };
  EXPECT_LT(check(range(1.2e-38, 3e38, true)), kLog2Error);
  EXPECT_LT(check(range(0.7, 1.6, false)), kLog2Error) << "through 1";
}

TEST(WideMath, Reciprocal) {
  const auto error = [](double a, double y) { return relative(y, 1.0 / a); };
  const auto x = range(1e-37, 1e37, true);
  EXPECT_LT(worstError(x, probeMath(MathFunction::kReciprocal, x, 16), error), kReciprocalError);
  auto negative = range(-2, -1, false);
  EXPECT_LT(worstError(negative, probeMath(MathFunction::kReciprocal, negative, 16), error),
            kReciprocalError);
}

TEST(WideMath, ReciprocalSquareRoot) {
  const auto x = range(1e-37, 1e37, true);
  EXPECT_LT(worstError(x, probeMath(MathFunction::kRsqrt, x, 16),
                       [](double a, double y) { return relative(y, 1.0 / std::sqrt(a)); }),
            kRsqrtError);
}

TEST(WideMath, NormalQuantile) {
  const boost::math::normal normal;
  // z goes through 0 at u = 1/2, where 1 - 2u is exact but its relative error is not meaningful
  // below half an ulp of u.
  const auto error = [&](double u, double z) {
    const double want = quantile(complement(normal, u));
    return std::abs(z - want) / std::max(std::abs(want), 1e-6);
  };
  for (const auto& u :
       {range(1.2e-10, 0.5, true), range(0.4, 0.6, false), range(0.5, 0.999999, false)})
    EXPECT_LT(worstError(u, probeMath(MathFunction::kNormalUpperQuantile, u, 16), error),
              kQuantileError);
}

TEST(WideMath, NormalQuantileIsFiniteAtEveryUniform) {
  // U(0) and the largest value that U takes: it rounds to 1.
  for (const float z : probeMath(MathFunction::kNormalUpperQuantile, {0x1p-33f, 1.0f, 0.5f}, 16))
    EXPECT_TRUE(std::isfinite(z)) << z;
}

TEST(WideMath, SameBitsAtEveryWidth) {
  const std::pair<MathFunction, std::vector<float>> cases[] = {
      {MathFunction::kExp2, range(-130, 126, false)},
      {MathFunction::kLog2, range(1.2e-38, 3e38, true)},
      {MathFunction::kReciprocal, range(1e-37, 1e37, true)},
      {MathFunction::kRsqrt, range(1e-37, 1e37, true)},
      {MathFunction::kNormalUpperQuantile, range(1.2e-10, 1, true)}};
  for (const auto& [function, x] : cases) {
    const auto one = probeMath(function, x, 1);
    for (const int width : {4, 8, 16}) {
      const auto wide = probeMath(function, x, width);
      std::size_t different = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        different += std::bit_cast<std::uint32_t>(one[i]) != std::bit_cast<std::uint32_t>(wide[i]);
      EXPECT_EQ(different, 0u) << "function " << static_cast<int>(function) << " width " << width;
    }
  }
}

}  // namespace
}  // namespace glintmark
