#include "host/reference/rough_metal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glintmark::reference {
namespace {

constexpr int kSteps = 96;
constexpr double kLeastLost = 1e-9;  // of a mirror that loses nothing

// The lobe's energy falls and rises again within cosines of the size of the roughness.
double warped(double mu, double alpha) {
  return mu * (1 + 2 * alpha) / (mu + 2 * alpha);
}

double unwarped(double t, double alpha) {
  return 2 * alpha * t / (1 + 2 * alpha - t);
}

// Schlick's reflectance, averaged over a hemisphere with the cosine: integral of 2 mu (1 - mu)^5 is
// 1 / 21. [Kulla and Conty 2017]
double meanReflectance(double f0) {
  return f0 + (1 - f0) / 21;
}

double interpolated(const std::vector<AlbedoParts>& parts, double t, double AlbedoParts::*part) {
  const double at = std::clamp(t, 0.0, 1.0) * kSteps;
  const std::size_t i = std::min(static_cast<std::size_t>(at), parts.size() - 2);
  const double share = at - static_cast<double>(i);
  return parts[i].*part * (1 - share) + parts[i + 1].*part * share;
}

}  // namespace

RoughMetal::RoughMetal(double alpha, std::function<double(double)> energy)
    : alpha_(alpha), energy_(std::move(energy)) {
  for (int i = 0; i <= kSteps; ++i)
    parts_.push_back(microfacetAlbedoParts(
        Ndf::kBeckmann, std::max(unwarped(static_cast<double>(i) / kSteps, alpha), 1e-6), alpha));
  constexpr int kCosines = 512;
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    const double mu = (i + 0.5) / kCosines;
    sum += 2 * mu * mirror(mu) / kCosines;
  }
  mean_ = sum;
}

double RoughMetal::mirror(double mu) const {
  return std::min(interpolated(parts_, warped(mu, alpha_), &AlbedoParts::mirror), 1.0);
}

double RoughMetal::schlick(double mu) const {
  return interpolated(parts_, warped(mu, alpha_), &AlbedoParts::schlick);
}

double RoughMetal::gain(MetalWay way, double f0, double mu) const {
  if (way != MetalWay::kTurquin && way != MetalWay::kMean) return 1;
  const double energy = way == MetalWay::kTurquin && energy_ ? energy_(mu) : mirror(mu);
  const double colour = way == MetalWay::kTurquin ? f0 : meanReflectance(f0);
  return 1 + colour * (1 / energy - 1);
}

double RoughMetal::beside(MetalWay way, double f0, double mu) const {
  const double mean = meanReflectance(f0);
  if (way == MetalWay::kKullaConty) return mean * mean * mean_ / (1 - mean * (1 - mean_));
  if (way != MetalWay::kFdezAguera) return 0;
  return albedo(MetalWay::kSingle, f0, mu) * mean / (1 - mean * (1 - mirror(mu)));
}

double RoughMetal::brdfTimesCosine(MetalWay way, double f0, const glm::dvec3& light,
                                   const glm::dvec3& view) const {
  if (light.z <= 0 || view.z <= 0) return 0;
  const double facing = glm::dot(glm::normalize(light + view), view);
  const double fresnel = f0 + (1 - f0) * std::pow(1 - std::clamp(facing, 0.0, 1.0), 5);
  const double lobe = fresnel * microfacetTimesCosine(Ndf::kBeckmann, light, view, alpha_);
  const double lost = 1 - mirror(view.z);
  // Kulla and Conty's lobe has the light's loss too, Fdez-Aguera's is Lambert's.
  const double shape =
      way == MetalWay::kKullaConty ? (1 - mirror(light.z)) / std::max(1 - mean_, kLeastLost) : 1.0;
  return lobe * gain(way, f0, view.z) +
         beside(way, f0, view.z) * lost * shape * light.z / std::numbers::pi;
}

double RoughMetal::albedo(MetalWay way, double f0, double mu) const {
  const double single = f0 * (mirror(mu) - schlick(mu)) + schlick(mu);
  if (way == MetalWay::kSingle) return single;
  return single * gain(way, f0, mu) + beside(way, f0, mu) * (1 - mirror(mu));
}

}  // namespace glintmark::reference
