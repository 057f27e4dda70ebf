// Integrals over directions by Boost's adaptive Gauss-Kronrod rule, the oracle of these tests.
#pragma once
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <glm/glm.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace glintmark {

using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
inline constexpr unsigned kQuadratureDepth = 7;

/// Integral of g over directions with z from z_low to z_high, to a relative tolerance.
inline double integrateDirections(const std::function<double(const glm::dvec3&)>& g,
                                  double z_low = 0, double z_high = 1, double tolerance = 1e-7) {
  const auto ring = [&](double z) {
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    const auto at = [&](double angle) {
      return g({radius * std::cos(angle), radius * std::sin(angle), z});
    };
    return Quadrature::integrate(at, 0.0, 2 * std::numbers::pi, kQuadratureDepth, tolerance);
  };
  return Quadrature::integrate(ring, z_low, z_high, kQuadratureDepth, tolerance);
}

}  // namespace glintmark
