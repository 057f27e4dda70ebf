#include "host/fit/meso_convolution.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "host/core/error.h"
#include "host/reference/scaled_cosine.h"

namespace glintmark {
namespace {

// Coefficients fall as exp(-l alpha): at 0.03 + 0.03, the narrowest, degree 700 is at 1e-18.
constexpr int kDegrees = 700;
constexpr int kCoefficientNodes = 4000;
constexpr int kSphereNodes = 700;

// Integrals of P_l times the lobe: over its quantiles, where it is flat. The share of the lobe
// outside the cone of half-angle theta is u with cos^2 theta = (1 - u) / (1 - u + alpha^2 u).
std::vector<double> legendreCoefficients(double alpha) {
  std::vector<double> coefficients(kDegrees, 0.0);
  for (int n = 0; n < kCoefficientNodes; ++n) {
    const double t = (n + 0.5) / kCoefficientNodes;
    const double inside = (1 - t) * (1 - t);  // 1 - u, denser towards the horizon
    const double weight = 2 * (1 - t) / kCoefficientNodes;
    const double c = std::sqrt(inside / (inside + alpha * alpha * (1 - inside)));
    double before = 1, current = c;
    coefficients[0] += weight;
    for (int l = 1; l < kDegrees; ++l) {
      coefficients[l] += weight * current;
      const double next = ((2 * l + 1) * c * current - l * before) / (l + 1);
      before = current;
      current = next;
    }
  }
  return coefficients;
}

}  // namespace

MesoConvolution::MesoConvolution(std::vector<double> alphas)
    : alphas_(std::move(alphas)), coefficients_(alphas_.size()) {
  for (const double alpha : alphas_) {
    if (!(alpha >= kLeastAlpha && alpha <= 1)) {
      throw Error(fmt::format("cannot convolve a lobe of roughness {}; roughness is {} to 1", alpha,
                              kLeastAlpha));
    }
  }
  tbb::parallel_for(std::size_t{0}, alphas_.size(),
                    [&](std::size_t i) { coefficients_[i] = legendreCoefficients(alphas_[i]); });
  legendre_.resize(static_cast<std::size_t>(kDegrees) * kSphereNodes);
  for (int n = 0; n < kSphereNodes; ++n) {
    // Angles pi s^2, dense about the axis.
    const double s = (n + 0.5) / kSphereNodes;
    const double angle = std::numbers::pi * s * s, c = std::cos(angle);
    cosine_.push_back(c);
    weight_.push_back(2 * std::numbers::pi * std::sin(angle) * 2 * std::numbers::pi * s /
                      kSphereNodes);
    for (int l = 0; l < kDegrees; ++l) {
      double* at = &legendre_[static_cast<std::size_t>(l) * kSphereNodes + n];
      *at = l == 0   ? 1
            : l == 1 ? c
                     : ((2 * l - 1) * c * at[-kSphereNodes] - (l - 1) * at[-2 * kSphereNodes]) / l;
    }
  }
}

double MesoConvolution::density(int i, int j, double angle_rad) const {
  double sum = 0;
  for (int l = 0; l < kDegrees; ++l) {
    sum += (2 * l + 1) * coefficients_[i][l] * coefficients_[j][l] *
           std::legendre(static_cast<unsigned>(l), std::cos(angle_rad));
  }
  return sum / (4 * std::numbers::pi);
}

MesoConvolution::Closest MesoConvolution::closest(int i, int j) const {
  std::vector<double> density(kSphereNodes, 0.0);
  for (int l = 0; l < kDegrees; ++l) {
    const double factor =
        (2 * l + 1) * coefficients_[i][l] * coefficients_[j][l] / (4 * std::numbers::pi);
    const double* p = &legendre_[static_cast<std::size_t>(l) * kSphereNodes];
    for (int n = 0; n < kSphereNodes; ++n) density[n] += factor * p[n];
  }
  const auto difference = [&](double alpha) {
    double sum = 0;
    for (int n = 0; n < kSphereNodes; ++n) {
      sum += weight_[n] * std::abs(density[n] - reference::scaledCosineDensity(alpha, cosine_[n]));
    }
    return sum;
  };
  // Golden section between the rougher lobe and more than the sum of both.
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.9 * std::max(alphas_[i], alphas_[j]), high = 1.1 * (alphas_[i] + alphas_[j]);
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = difference(a), at_b = difference(b);
  for (int k = 0; k < 40; ++k) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = difference(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = difference(b);
    }
  }
  return {0.5 * (low + high), std::min(at_a, at_b)};
}

}  // namespace glintmark
