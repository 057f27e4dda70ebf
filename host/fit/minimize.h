// Quasi-Newton minimisation of a smooth function of a few variables.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace glintmark {

template <std::size_t N>
struct Minimum {
  std::array<double, N> at{};
  double value = 0;
};

struct MinimizeLimits {
  int iterations = 60;
  double least_gain = 1e-9;  // an iteration that gains less (absolute) is the last
};

namespace minimize_detail {

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

/// Approximation of the inverse Hessian; starts as the unit matrix.
template <std::size_t N>
class InverseHessian {
 public:
  InverseHessian() {
    for (std::size_t i = 0; i < N; ++i) rows_[i][i] = 1;
  }

  std::array<double, N> times(const std::array<double, N>& v) const {
    std::array<double, N> out{};
    for (std::size_t i = 0; i < N; ++i) out[i] = dot(rows_[i], v);
    return out;
  }

  /// [NW06] Eq. 6.17 for a step and the change of the gradient over it. Left out where the
  /// curvature along the step is not positive.
  void update(const std::array<double, N>& step, const std::array<double, N>& change) {
    const double curvature = dot(step, change);
    if (!(curvature > 1e-12 * std::sqrt(dot(step, step) * dot(change, change)))) return;
    const std::array<double, N> h_change = times(change);
    const double factor = (1 + dot(change, h_change) / curvature) / curvature;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        rows_[i][j] += factor * step[i] * step[j] -
                       (h_change[i] * step[j] + step[i] * h_change[j]) / curvature;
      }
    }
  }

 private:
  std::array<std::array<double, N>, N> rows_{};
};

}  // namespace minimize_detail

/// Minimises `function(x, gradient) -> value` from `start` by BFGS with a backtracking line search.
/// Variables should be scaled such that a step of 1 is a large one. The result is never worse than
/// the start. [NW06] Nocedal and Wright, "Numerical Optimization", 2006, Algorithms 3.1 and 6.1
template <std::size_t N, typename Function>
Minimum<N> minimize(const Function& function, const std::array<double, N>& start,
                    const MinimizeLimits& limits = {}) {
  using Vector = std::array<double, N>;
  constexpr double kArmijo = 1e-4, kShrink = 0.4, kLongestStep = 0.5;
  constexpr int kBacktracks = 14;
  minimize_detail::InverseHessian<N> inverse;
  Vector gradient{};
  Minimum<N> best{start, function(start, gradient)};
  for (int iteration = 0; iteration < limits.iterations; ++iteration) {
    Vector direction = inverse.times(gradient);
    double slope = -minimize_detail::dot(direction, gradient);
    if (!(slope < 0)) break;
    const double length = std::sqrt(minimize_detail::dot(direction, direction));
    double t = length > kLongestStep ? kLongestStep / length : 1;
    Vector at{}, next_gradient{};
    double value = 0;
    bool lower = false;
    for (int i = 0; i < kBacktracks && !lower; ++i, t *= lower ? 1 : kShrink) {
      for (std::size_t k = 0; k < N; ++k) at[k] = best.at[k] - t * direction[k];
      value = function(at, next_gradient);
      lower = value <= best.value + kArmijo * t * slope;
    }
    if (!lower) break;
    Vector step{}, change{};
    for (std::size_t k = 0; k < N; ++k) {
      step[k] = at[k] - best.at[k];
      change[k] = next_gradient[k] - gradient[k];
    }
    inverse.update(step, change);
    const double gain = best.value - value;
    best = {at, value};
    gradient = next_gradient;
    if (gain < limits.least_gain) break;
  }
  return best;
}

}  // namespace glintmark
