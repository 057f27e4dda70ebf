// Polynomials through functions.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "host/core/angles.h"

namespace glintmark {

/// Coefficients, lowest power first, of the polynomial through f on [0, 1] at N Chebyshev points,
/// by Newton's divided differences. f: double to double.
template <std::size_t N, typename Function>
void interpolateAtChebyshevPoints(Function&& f, float (&out)[N]) {
  std::array<double, N> x{}, difference{}, power{};
  for (std::size_t i = 0; i < N; ++i) {
    x[i] = 0.5 - 0.5 * std::cos(kPi * (static_cast<double>(i) + 0.5) / N);
    difference[i] = f(x[i]);
  }
  for (std::size_t k = 1; k < N; ++k)
    for (std::size_t i = N - 1; i >= k; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (x[i] - x[i - k]);
  for (std::size_t k = N; k-- > 0;) {
    // power = power * (t - x[k]) + difference[k]
    for (std::size_t i = N - 1; i > 0; --i) power[i] = power[i - 1] - x[k] * power[i];
    power[0] = difference[k] - x[k] * power[0];
  }
  std::ranges::transform(power, out, [](double c) { return static_cast<float>(c); });
}

}  // namespace glintmark
