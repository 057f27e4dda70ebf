#include "host/frame/multiscatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace glintmark {
namespace {

constexpr double kPi = std::numbers::pi;

// The polynomial through a function on [0, 1] at Chebyshev points, by Newton's divided differences.
void interpolate(const std::function<double(double)>& f, float (&out)[MS_DEGREES]) {
  std::array<double, MS_DEGREES> x{}, difference{}, power{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = 0.5 - 0.5 * std::cos(kPi * (static_cast<double>(i) + 0.5) / MS_DEGREES);
    difference[i] = f(x[i]);
  }
  for (std::size_t k = 1; k < x.size(); ++k)
    for (std::size_t i = x.size() - 1; i >= k; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (x[i] - x[i - k]);
  for (std::size_t k = x.size(); k-- > 0;) {
    // power = power * (t - x[k]) + difference[k]
    for (std::size_t i = power.size() - 1; i > 0; --i) power[i] = power[i - 1] - x[k] * power[i];
    power[0] = difference[k] - x[k] * power[0];
  }
  std::ranges::transform(power, out, [](double c) { return static_cast<float>(c); });
}

float4 mapColour(const float4& colour, const std::function<double(double)>& f) {
  return {static_cast<float>(f(colour.x)), static_cast<float>(f(colour.y)),
          static_cast<float>(f(colour.z)), 0};
}

// Cubic of the cosine of incidence at one roughness.
float4 atRoughness(const std::array<std::array<double, 4>, 4>& c, double alpha) {
  const auto value = [&](std::size_t i) {
    return static_cast<float>(c[i][0] + alpha * (c[i][1] + alpha * (c[i][2] + alpha * c[i][3])));
  };
  return {value(0), value(1), value(2), value(3)};
}

void prepareLobes(const GlintMaterial& material, const LobePolynomials& p, double alpha,
                  MultiscatterMaterial& out) {
  const double eta = lobeAt(p, 1, alpha).exponent;
  out.scale = atRoughness(p.scale, alpha);
  out.flattening = atRoughness(p.flattening, alpha);
  out.exponent = static_cast<float>(eta - 1);
  out.single = mapColour(material.albedo, [](double rho) { return rho / kPi; });
  out.multiple = mapColour(material.albedo, [&](double rho) {
    return rho * rho * (1 + p.third_order * rho) * (2 + eta) / (2 * kPi * kPi);
  });
  interpolate([&](double mu) { return lobeModelShare(p, alpha, 1, mu, 1); }, out.share);
}

void prepareEon(const GlintMaterial& material, double alpha, MultiscatterMaterial& out) {
  const double r = eonRoughness(alpha);
  const double a_f = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r);
  const double mean = a_f * (1 + (2.0 / 3.0 - 28 / (15 * kPi)) * r);
  out.exponent = static_cast<float>(r);
  out.single = mapColour(material.albedo, [&](double rho) { return rho * a_f / kPi; });
  out.multiple = mapColour(material.albedo, [&](double rho) {
    return rho * rho * mean / (1 - rho * (1 - mean)) / kPi / std::max(1 - mean, 1e-7);
  });
  interpolate([&](double mu) { return 1 - eonAlbedo(mu, r); }, out.share);
}

}  // namespace

MultiscatterMaterial prepareMultiscatter(const GlintMaterial& material, Multiscatter model,
                                         double diffuse_roughness, const LobePolynomials& refit,
                                         const MirrorAlbedo* mirror) {
  MultiscatterMaterial out{};
  if (model == Multiscatter::kPublished)
    prepareLobes(material, kPublishedCode, diffuse_roughness, out);
  if (model == Multiscatter::kRefit) prepareLobes(material, refit, diffuse_roughness, out);
  if (model == Multiscatter::kEon) prepareEon(material, diffuse_roughness, out);
  if (mirror) {
    const double alpha = std::sqrt(static_cast<double>(material.alpha_g.x) * material.alpha_g.y);
    interpolate([&](double mu) { return 1 / mirror->at(alpha, mu) - 1; }, out.compensation);
  }
  return out;
}

MultiscatterMaterial prepareMultiscatter(const Material& material, const KernelConfig& config) {
  // Tables are read only by materials that need them.
  const bool refit = config.multiscatter == Multiscatter::kRefit;
  return prepareMultiscatter(material.glint, config.multiscatter, material.diffuse_roughness,
                             refit ? multiscatterData().refit : LobePolynomials{},
                             config.metal_compensation ? &multiscatterData().mirror : nullptr);
}

}  // namespace glintmark
