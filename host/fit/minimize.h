// Quasi-Newton minimisation of a smooth function of a few variables, by Ceres.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>

namespace glintmark {

template <std::size_t N>
struct Minimum {
  std::array<double, N> at{};
  double value = 0;
};

struct MinimizeLimits {
  int iterations = 60;
  double least_gain = 1e-9;  // an iteration that gains less, relative to the value, is the last
  double unit = 1;           // of all variables: the first step is no longer
};

/// Value of a function and, unless it is empty, its gradient.
using Differentiable =
    std::function<double(std::span<const double> at, std::span<double> gradient)>;

/// Moves `at` to a minimum nearby, by BFGS with a line search for Wolfe's conditions, and returns
/// the value there: never more than at the start.
double minimizeInPlace(const Differentiable& function, std::span<double> at,
                       const MinimizeLimits& limits);

/// The same for `function(x, gradient) -> value` of arrays.
template <std::size_t N, typename Function>
Minimum<N> minimize(const Function& function, const std::array<double, N>& start,
                    const MinimizeLimits& limits = {}) {
  Minimum<N> best{start, 0};
  best.value = minimizeInPlace(
      [&](std::span<const double> at, std::span<double> gradient) {
        std::array<double, N> x, by_x{};
        std::ranges::copy(at, x.begin());
        const double value = function(x, by_x);
        if (!gradient.empty()) std::ranges::copy(by_x, gradient.begin());
        return value;
      },
      best.at, limits);
  return best;
}

}  // namespace glintmark
