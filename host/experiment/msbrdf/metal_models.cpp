#include "host/experiment/msbrdf/metal_models.h"

#include <algorithm>
#include <cmath>

#include "host/fit/multiscatter_data.h"

namespace glintmark {
namespace {

using reference::MetalWay;

// Indices at about 630, 530 and 465 nm, rounded, after Johnson and Christy, Phys. Rev. B 6, 1972
// (copper, gold), and Rakic, Applied Optics 34, 1995 (aluminium).
constexpr Conductor kConductors[] = {
    {"copper", {0.20, 0.92, 1.10}, {3.91, 2.45, 2.14}, std::nullopt},
    {"gold", {0.14, 0.37, 1.44}, {3.98, 2.39, 1.60}, std::nullopt},
    {"aluminium", {1.35, 0.97, 0.62}, {7.47, 6.40, 5.30}, std::nullopt},
    {"schlick", {1, 1, 1}, {0, 0, 0}, glm::dvec3(0.95, 0.64, 0.54)},
    {"tinted", {1, 1, 1}, {0, 0, 0}, glm::dvec3(0.9, 0.5, 0.2), 0.5}};

MetalWay metalWay(Compensation compensation) {
  switch (compensation) {
    case Compensation::kOff:
      return MetalWay::kSingle;
    case Compensation::kMean:
      return MetalWay::kMean;
    case Compensation::kKullaConty:
      return MetalWay::kKullaConty;
    case Compensation::kFdezAguera:
      return MetalWay::kFdezAguera;
    default:
      return MetalWay::kTurquin;
  }
}

// As the kernels take it: never less than the lobe's.
double simulatedEnergy(double alpha, double mu) {
  const MirrorAlbedo& mirror = multiscatterData().mirror;
  const double t = MirrorAlbedo::warp(alpha, mu);
  return std::max(mirror.at(mirror.simulated, alpha, t), mirror.at(mirror.lobe, alpha, t));
}

}  // namespace

double Conductor::reflectance(int channel) const {
  if (f0) return (*f0)[channel];
  const double less = n[channel] - 1, more = n[channel] + 1, k_sq = k[channel] * k[channel];
  return (less * less + k_sq) / (more * more + k_sq);
}

std::span<const Conductor> conductors() {
  return kConductors;
}

SimulationSettings metalSettings(const Conductor& metal, int channel, SurfaceModel model,
                                 double alpha, double incidence_deg, std::uint64_t rays) {
  SimulationSettings s;
  s.model = model;
  s.kind = SurfaceKind::kMetal;
  s.alpha = glm::dvec2(alpha);
  s.incidence_deg = incidence_deg;
  s.orders = static_cast<int>(HF_MAX_ORDERS);
  s.rays = rays;
  s.seed = static_cast<std::uint32_t>(channel + 1);
  s.index_n = metal.n[channel];
  s.index_k = metal.k[channel];
  if (metal.f0) {
    s.f0 = (*metal.f0)[channel];
    s.tint = metal.tint;
  }
  return s;
}

MetalModels::MetalModels(double alpha)
    : lobe_(alpha), simulated_(alpha, [alpha](double mu) { return simulatedEnergy(alpha, mu); }) {}

const reference::RoughMetal& MetalModels::metal(Compensation way) const {
  return way == Compensation::kSimulated ? simulated_ : lobe_;
}

double MetalModels::albedo(Compensation way, double f0, double mu) const {
  return metal(way).albedo(metalWay(way), f0, mu);
}

double MetalModels::lobeError(Compensation way, double f0, const LobeData& data) const {
  constexpr int kParts = 6;  // of a cell, along cosine and azimuth
  constexpr double kCosineStep = 1.0 / (LobeData::kCosines * kParts);
  constexpr double kAzimuthStep = std::numbers::pi / (LobeData::kAzimuths * kParts);
  const glm::dvec3 view(std::sqrt(1 - data.mu_in * data.mu_in), 0, data.mu_in);
  const reference::RoughMetal& model = metal(way);
  double squares = 0;
  for (int cell = 0; cell < LobeData::kCosines * LobeData::kAzimuths; ++cell) {
    const int row = cell / LobeData::kAzimuths, column = cell % LobeData::kAzimuths;
    double mean = 0;
    for (int part = 0; part < kParts * kParts; ++part) {
      const double z = 1 - (row * kParts + part / kParts + 0.5) * kCosineStep;
      const double phi = (column * kParts + part % kParts + 0.5) * kAzimuthStep;
      const double r = std::sqrt(1 - z * z);
      const glm::dvec3 light(r * std::cos(phi), r * std::sin(phi), z);
      mean += model.brdfTimesCosine(metalWay(way), f0, light, view) / (kParts * kParts);
    }
    const double difference = mean - data.energy[static_cast<std::size_t>(cell)];
    squares += difference * difference;
  }
  return std::sqrt(squares / (LobeData::kCosines * LobeData::kAzimuths)) /
         (data.share / (2 * std::numbers::pi));
}

}  // namespace glintmark
