#include "host/fit/ltc_objective.h"

#include <cmath>
#include <numbers>

namespace glintmark {

namespace {

using Gradient = std::array<double, 4>;

// Derivatives by (log width_x, log width_y, shear / width_x, turn) of LtcFactors, which are short
// to write down, into derivatives by the members of LtcLobe.
Gradient toLobe(const Gradient& g, const LtcFactors& f) {
  const double stretch_sq = 1 + f.shear * f.shear, k = f.shear / stretch_sq;
  const double relative_shear = f.shear / f.width_x;
  return {
      g[0] - relative_shear * g[2], g[1],
      2 * k * g[0] + k * g[1] + (1 / f.width_x - 2 * k * relative_shear) * g[2] - g[3] / stretch_sq,
      g[3]};
}

struct FactorsMass {
  double share = 1;
  Gradient gradient{};  // in the order of toLobe's argument
};

// reference::ltcMassAboveHorizon with row z of M = R S written out: (u, 0, v).
FactorsMass massAboveHorizon(const LtcFactors& f) {
  const double c = f.cos_turn, s = f.sin_turn;
  const double u = -s * f.width_x, v = c - s * f.shear;
  const double length = std::hypot(u, v), cube = length * length * length;
  const auto derivative = [&](double du, double dv) { return 0.5 * u * (u * dv - v * du) / cube; };
  return {.share = 0.5 * (1 + v / length),
          .gradient = {derivative(u, -s * f.shear), 0, derivative(0, -s * f.width_x),
                       derivative(-c * f.width_x, -s - c * f.shear)}};
}

}  // namespace

double ltcFitError(const LtcSamples& samples, const LtcLobe& lobe,
                   std::array<double, 4>& gradient) {
  const LtcFactors f = factorsOf(lobe);
  const double c = f.cos_turn, s = f.sin_turn;
  const double inverse_x = 1 / f.width_x, inverse_y = 1 / f.width_y;
  const double inverse_y_sq = inverse_y * inverse_y, shear = f.shear * inverse_x;
  const FactorsMass mass = samples.whole_sphere ? FactorsMass{} : massAboveHorizon(f);
  const double factor = inverse_x * inverse_y / (std::numbers::pi * mass.share);
  const double inverse_albedo = 1 / samples.albedo;
  const double* x = samples.x.data();
  const double* y_sq = samples.y_sq.data();
  const double* z = samples.z.data();
  const double* weight = samples.weight.data();
  const double* brdf = samples.brdf.data();

  double error = 0, signed_density = 0;
  double by_width_x = 0, by_width_y = 0, by_shear = 0, by_turn = 0;
  const int count = static_cast<int>(samples.x.size());
  // t = S^-1 R^T (x, y, z); density = factor t_z / |t|^4.
#pragma omp simd reduction(+ : error, signed_density, by_width_x, by_width_y, by_shear, by_turn)
  for (int i = 0; i < count; ++i) {
    const double turned_x = c * x[i] - s * z[i], turned_z = s * x[i] + c * z[i];
    const double scaled_x = inverse_x * turned_x;
    const double tx = scaled_x - shear * turned_z;
    const double ty_sq = inverse_y_sq * y_sq[i];
    const double inverse_q = 1 / (tx * tx + ty_sq + turned_z * turned_z);
    const double above = turned_z > 0 ? factor : 0;
    const double slope = above * inverse_q * inverse_q;  // of the density in t_z
    const double density = slope * turned_z;
    const double difference = weight[i] * (density - brdf[i] * inverse_albedo);
    const double sign = difference < 0 ? -weight[i] : weight[i];
    const double signed_weighted = sign * density, k = 4 * inverse_q;
    error += difference < 0 ? -difference : difference;
    signed_density += signed_weighted;
    by_width_x += signed_weighted * (k * tx * scaled_x - 1);
    by_width_y += signed_weighted * (k * ty_sq - 1);
    by_shear += signed_weighted * k * tx * turned_z;
    by_turn += sign * slope * turned_x +
               signed_weighted * k *
                   (tx * (inverse_x * turned_z + shear * turned_x) - turned_z * turned_x);
  }
  Gradient by_factors = {by_width_x, by_width_y, by_shear, by_turn};
  for (std::size_t k = 0; k < 4; ++k) {
    by_factors[k] -= signed_density * mass.gradient[k] / mass.share;
  }
  gradient = toLobe(by_factors, f);
  return error;
}

}  // namespace glintmark
