// The kernels' own elementary functions: errors as stated in wide_math.clh, and the same bits at
// every lane count.
#include <bit>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "host/harness/probes.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr std::size_t kArguments = 1 << 16;

// kArguments floats from `low` to `high`, evenly spaced, or evenly in their logarithm.
std::vector<float> range(double low, double high, bool logarithmic) {
  std::vector<float> x(kArguments);
  for (std::size_t i = 0; i < kArguments; ++i) {
    const double t = static_cast<double>(i) / (kArguments - 1);
    x[i] = static_cast<float>(logarithmic ? low * std::pow(high / low, t) : low + (high - low) * t);
  }
  return x;
}

using ErrorOf = std::function<double(double x, double y)>;

void addErrors(const CheckContext& context, Finding& finding, MathFunction function,
               const std::vector<float>& x, const ErrorOf& error) {
  const std::vector<float> y = probeMath(context.bench, function, x, context.lanes);
  for (std::size_t i = 0; i < x.size(); ++i) finding.add(error(x[i], y[i]));
}

double relative(double got, double want) {
  return std::abs(got - want) / std::abs(want);
}

Finding exp2Error(const CheckContext& context) {
  Finding finding(kExp2Error);
  addErrors(context, finding, MathFunction::kExp2, range(-125.5, 126, false),
            [](double x, double y) { return relative(y, std::exp2(x)); });
  return finding;
}

Finding exp2FromBelow(const CheckContext& context) {
  constexpr float kLowest = -std::numeric_limits<float>::infinity();
  Finding finding(0);
  addErrors(context, finding, MathFunction::kExp2, {-127.f, -1e4f, -1e30f, kLowest},
            [](double, double y) { return std::abs(y - std::exp2(-126.)); });
  return finding;
}

Finding log2Error(const CheckContext& context) {
  Finding finding(kLog2Error);
  const auto error = [](double x, double y) {
    const double want = std::log2(x), half_ulp = std::abs(want) * 0x1p-24;
    return std::abs(y - want) - half_ulp;
  };
  addErrors(context, finding, MathFunction::kLog2, range(1.2e-38, 3e38, true), error);
  addErrors(context, finding, MathFunction::kLog2, range(0.7, 1.6, false), error);  // through 0
  return finding;
}

Finding reciprocalError(const CheckContext& context) {
  Finding finding(kReciprocalError);
  for (const auto& x : {range(1e-37, 1e37, true), range(-2, -1, false)})
    addErrors(context, finding, MathFunction::kReciprocal, x,
              [](double a, double y) { return relative(y, 1 / a); });
  return finding;
}

Finding rsqrtError(const CheckContext& context) {
  Finding finding(kRsqrtError);
  addErrors(context, finding, MathFunction::kRsqrt, range(1e-37, 1e37, true),
            [](double x, double y) { return relative(y, 1 / std::sqrt(x)); });
  return finding;
}

Finding rootError(const CheckContext& context) {
  Finding finding(kRsqrtError);
  addErrors(context, finding, MathFunction::kRoot, range(1e-35, 1e37, true),
            [](double x, double y) { return relative(y, std::sqrt(x)); });
  addErrors(context, finding, MathFunction::kRoot, {0.0f, -1.0f, 1e-38f},
            [](double, double y) { return y < 4e-18 ? 0 : y; });
  return finding;
}

Finding expComplementError(const CheckContext& context) {
  Finding finding(kExpComplementError);
  for (const auto& x : {range(1e-30, 100, true), range(0.01, 0.1, false)})
    addErrors(context, finding, MathFunction::kExpComplement, x,
              [](double a, double y) { return relative(y, -std::expm1(-a)); });
  return finding;
}

Finding quantileError(const CheckContext& context) {
  const boost::math::normal normal;
  Finding finding(kQuantileError);
  // z goes through 0 at u = 1/2, where 1 - 2u is exact but its relative error is not meaningful
  // below half an ulp of u.
  for (const auto& u :
       {range(1.2e-10, 0.5, true), range(0.4, 0.6, false), range(0.5, 0.999999, false)})
    addErrors(context, finding, MathFunction::kNormalUpperQuantile, u, [&](double x, double z) {
      const double want = quantile(complement(normal, x));
      return std::abs(z - want) / std::max(std::abs(want), 1e-6);
    });
  return finding;
}

// U(0) and the largest value that U takes: it rounds to 1.
Finding quantileEnds(const CheckContext& context) {
  Finding finding(0);
  addErrors(context, finding, MathFunction::kNormalUpperQuantile, {0x1p-33f, 1.0f, 0.5f},
            [](double, double z) { return std::isfinite(z) ? 0 : 1; });
  return finding;
}

Finding sameValues(const CheckContext& context) {
  const std::pair<MathFunction, std::vector<float>> cases[] = {
      {MathFunction::kExp2, range(-130, 126, false)},
      {MathFunction::kLog2, range(1.2e-38, 3e38, true)},
      {MathFunction::kReciprocal, range(1e-37, 1e37, true)},
      {MathFunction::kRsqrt, range(1e-37, 1e37, true)},
      {MathFunction::kNormalUpperQuantile, range(1.2e-10, 1, true)},
      {MathFunction::kRoot, range(1e-37, 1e37, true)},
      {MathFunction::kExpComplement, range(1e-30, 100, true)}};
  Finding finding(0);
  for (const auto& [function, x] : cases) {
    const auto one = probeMath(context.bench, function, x, 1),
               wide = probeMath(context.bench, function, x, context.lanes);
    double different = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      different += std::bit_cast<std::uint32_t>(one[i]) != std::bit_cast<std::uint32_t>(wide[i]);
    finding.add(different);
  }
  return finding;
}

}  // namespace

std::vector<Check> mathsChecks() {
  return {{"maths/exp2", "relative error", exp2Error},
          {"maths/exp2_from_below", "distance from 2^-126", exp2FromBelow},
          {"maths/log2", "absolute error", log2Error},
          {"maths/reciprocal", "relative error", reciprocalError},
          {"maths/rsqrt", "relative error", rsqrtError},
          {"maths/root", "relative error", rootError},
          {"maths/exp_complement", "relative error", expComplementError},
          {"maths/quantile", "relative error", quantileError},
          {"maths/quantile_ends", "values that are not finite", quantileEnds},
          {"maths/same_bits", "values that differ from one lane's", sameValues}};
}

}  // namespace glintmark
