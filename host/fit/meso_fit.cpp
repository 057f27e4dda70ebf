#include "host/fit/meso_fit.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/error.h"
#include "host/fit/meso_convolution.h"
#include "host/fit/minimize.h"
#include "host/reference/scaled_cosine.h"
#include "kernels/area/meso_table.h"

namespace glintmark {
namespace {

constexpr double kLeastInverseAlpha = 1e-3;

// M + m^2 A (1 - M (C M + D m)) / (M + B m), and its derivatives by A to D.
//
// For narrow lobes the sphere is a plane and the overall roughness scales with both, so it is M
// times a function of m / M that starts as 1 + A (m / M)^2: a second lobe adds little while it is
// the narrower one. The bracket is what the sphere's curvature takes away.
double join(const std::array<double, 4>& c, double alpha_mi, double alpha_me,
            std::array<double, 4>& gradient) {
  const double large = std::max(alpha_mi, alpha_me), small = std::min(alpha_mi, alpha_me);
  if (large <= 0) return 0;
  const double denominator = large + c[1] * small;
  const double base = small * small / denominator;
  const double bracket = 1 - large * (c[2] * large + c[3] * small);
  gradient = {base * bracket, -c[0] * bracket * base * small / denominator,
              -c[0] * base * large * large, -c[0] * base * large * small};
  return large + c[0] * base * bracket;
}

std::array<double, 4> fitJoin(const MesoGrid& grid) {
  const auto sum_of_squares = [&](const std::array<double, 4>& c, std::array<double, 4>& gradient) {
    double sum = 0;
    gradient = {};
    for (int i = 1; i <= grid.count; ++i) {
      for (int j = 1; j <= grid.count; ++j) {
        std::array<double, 4> by_constant{};
        const double value = join(c, 1.0 * i / grid.count, 1.0 * j / grid.count, by_constant);
        const double error = std::min(value, 1.0) - grid.at(i, j);
        sum += error * error;
        if (value >= 1) continue;
        for (std::size_t k = 0; k < 4; ++k) gradient[k] += 2 * error * by_constant[k];
      }
    }
    return sum;
  };
  // The sum of squares is small and flat: the start is near what flat lobes need.
  return minimize<4>(sum_of_squares, {4, 5, 0.5, 0}, {.iterations = 1000, .least_gain = 1e-9}).at;
}

double rootOfLength(double length) {
  return std::sqrt(std::sqrt(std::max(1 - length, 0.0)));
}

// Interpolates alpha / t at Chebyshev nodes in x; Newton's divided differences, then powers of x.
std::array<double, 9> fitInverse() {
  constexpr std::size_t kCount = 9;
  const double low = rootOfLength(reference::meanResultantLength(kLeastInverseAlpha));
  const double high = rootOfLength(reference::meanResultantLength(1));
  std::array<double, kCount> x{}, difference{}, powers{};
  for (std::size_t k = 0; k < kCount; ++k) {
    const double node = std::cos(std::numbers::pi * (k + 0.5) / kCount);
    x[k] = std::lerp(low, high, 0.5 * (1 + node));
    const double t = x[k] * x[k];
    difference[k] = reference::alphaOfMeanLength(1 - t * t) / t;
  }
  for (std::size_t order = 1; order < kCount; ++order) {
    for (std::size_t k = kCount - 1; k >= order; --k) {
      difference[k] = (difference[k] - difference[k - 1]) / (x[k] - x[k - order]);
    }
  }
  for (std::size_t k = kCount; k-- > 0;) {  // powers <- powers * (X - x[k]) + difference[k]
    for (std::size_t i = kCount - 1; i > 0; --i) powers[i] = powers[i - 1] - x[k] * powers[i];
    powers[0] = difference[k] - x[k] * powers[0];
  }
  return powers;
}

}  // namespace

MesoConstants shippedMesoConstants() {
  return {
      .inverse = {MESO_INVERSE_0, MESO_INVERSE_1, MESO_INVERSE_2, MESO_INVERSE_3, MESO_INVERSE_4,
                  MESO_INVERSE_5, MESO_INVERSE_6, MESO_INVERSE_7, MESO_INVERSE_8},
      .join = {MESO_JOIN_A, MESO_JOIN_B, MESO_JOIN_C, MESO_JOIN_D}};
}

double mesoAlpha(const MesoConstants& constants, double length) {
  if (!(length > MESO_LENGTH_MIN)) return 1;
  const double x = rootOfLength(length);
  double ratio = 0;
  for (std::size_t k = constants.inverse.size(); k-- > 0;) ratio = ratio * x + constants.inverse[k];
  return std::clamp(x * x * ratio, 0.0, 1.0);
}

double overallAlpha(const MesoConstants& constants, double alpha_mi, double alpha_me) {
  std::array<double, 4> unused{};
  return std::min(join(constants.join, alpha_mi, alpha_me, unused), 1.0);
}

MesoGrid computeMesoGrid(int count, const Ranks& ranks) {
  if (count < 1 || count > 33) {
    throw Error(fmt::format("a grid of {} roughnesses is not possible; it has 1 to 33", count));
  }
  std::vector<double> alphas;
  for (int i = 1; i <= count; ++i) alphas.push_back(1.0 * i / count);
  const MesoConvolution convolution(alphas);
  MesoGrid grid{count, std::vector<double>(static_cast<std::size_t>(count) * count)};
  const auto at = [&](int i, int j) -> double& {
    return grid.alpha[static_cast<std::size_t>(i) * count + j];
  };
  tbb::parallel_for(0, count, [&](int i) {
    if (!ranks.makes(static_cast<std::size_t>(i))) return;
    for (int j = 0; j <= i; ++j) at(i, j) = std::min(convolution.closest(i, j).alpha, 1.0);
  });
  shareRows(ranks, std::span(grid.alpha), static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j) at(j, i) = at(i, j);
  return grid;
}

MesoConstants fitMeso(const MesoGrid& grid) {
  return {.inverse = fitInverse(), .join = fitJoin(grid)};
}

MesoErrors mesoErrors(const MesoGrid& grid, const std::function<double(double, double)>& overall) {
  MesoErrors errors;
  for (int i = 1; i <= grid.count; ++i) {
    for (int j = 1; j <= grid.count; ++j) {
      const double error = overall(1.0 * i / grid.count, 1.0 * j / grid.count) - grid.at(i, j);
      errors.sum_of_squares += error * error;
      errors.max = std::max(errors.max, std::abs(error));
    }
  }
  return errors;
}

double mesoInverseError(const MesoConstants& constants) {
  double largest = 0;
  constexpr int kSteps = 4000;
  for (int i = 0; i <= kSteps; ++i) {
    const double alpha = kLeastInverseAlpha * std::pow(1 / kLeastInverseAlpha, 1.0 * i / kSteps);
    const double found = mesoAlpha(constants, reference::meanResultantLength(alpha));
    largest = std::max(largest, std::abs(found / alpha - 1));
  }
  return largest;
}

}  // namespace glintmark
