#include "host/frame/effect/scattering_params.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "host/core/angles.h"
#include "host/frame/chebyshev.h"
#include "host/frame/effects.h"
#include "host/frame/specular_albedo.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

constexpr double kLeastRoom = 1e-6;  // of a surface so smooth that nothing is scattered twice

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

void prepareLobes(const Material& material, LobePolynomials p, MultiscatterMaterial& out) {
  const double alpha = material.diffuse_roughness;
  p.masking = material.diffuse_masking;
  const double eta = lobeAt(p, 1, alpha).exponent;
  const double third = p.thirdOverSecond(alpha);
  out.alpha = static_cast<float>(alpha);
  out.masking = static_cast<float>(p.masking);
  out.scale = atRoughness(p.scale, alpha);
  out.flattening = atRoughness(p.flattening, alpha);
  out.exponent = static_cast<float>(eta - 1);
  out.single = mapColour(material.params.surface.albedo, [](double rho) { return rho / kPi; });
  out.multiple = mapColour(material.params.surface.albedo, [&](double rho) {
    return rho * rho * (1 + third * rho) * (2 + eta) / (2 * kPi * kPi);
  });
  interpolateAtChebyshevPoints([&](double mu) { return lobeModelShare(p, alpha, 1, mu, 1); },
                               out.share);
  const LobeModel model(p, alpha);
  const double room = std::max(model.scattered(), kLeastRoom);
  interpolateAtChebyshevPoints([&](double mu) { return model.means(mu).plain / room; }, out.crowd);
  interpolateAtChebyshevPoints([&](double mu) { return model.means(mu).masked / room; },
                               out.masked_crowd);
}

void prepareEon(const MaterialParams& material, double r, MultiscatterMaterial& out) {
  const double a_f = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r);
  const double mean = a_f * (1 + (2.0 / 3.0 - 28 / (15 * kPi)) * r);
  out.exponent = static_cast<float>(r);
  out.single = mapColour(material.surface.albedo, [&](double rho) { return rho * a_f / kPi; });
  out.multiple = mapColour(material.surface.albedo, [&](double rho) {
    return rho * rho * mean / (1 - rho * (1 - mean)) / kPi / std::max(1 - mean, 1e-7);
  });
  interpolateAtChebyshevPoints([&](double mu) { return 1 - eonAlbedo(mu, r); }, out.share);
}

void prepareFitted(const MaterialParams& material, const FirstOrder& c, MultiscatterMaterial& out) {
  const ScatterModel model(c);
  const double mean = model.meanAlbedo();
  const auto f = [&c](std::size_t i) { return static_cast<float>(c[i]); };
  out.scale = {f(0), f(1), f(2), f(3)};
  out.flattening = {f(4), f(5), 0, 0};
  out.single = mapColour(material.surface.albedo, [](double rho) { return rho / kPi; });
  out.multiple = mapColour(material.surface.albedo, [&](double rho) {
    return rho * rho * mean / (1 - rho * (1 - mean)) / kPi / std::max(1 - mean, 1e-7);
  });
  // The sine at normal incidence is no polynomial's business.
  const double sine = model.sineShare();
  out.exponent = static_cast<float>(-sine);
  interpolateAtChebyshevPoints(
      [&](double mu) { return 1 - model.albedo(mu) + sine * std::sqrt(1 - mu * mu); }, out.share);
}

// Energy that a white mirror of a material's lobe reflects by one bounce, of a warped cosine.
class BounceEnergy {
 public:
  BounceEnergy(const Material& material, const MirrorAlbedo& mirror, double alpha)
      : material_(material), mirror_(mirror), alpha_(alpha) {}

  double at(double t) const {
    if (material_.ggx)
      return specularAlbedo(reference::Ndf::kGgx, MirrorAlbedo::cosine(alpha_, t), alpha_).mirror;
    const double lobe = mirror_.at(mirror_.lobe, alpha_, t);
    // Never more than the lobe lacks, whatever the noise of a simulation.
    return material_.compensation == Compensation::kSimulated
               ? std::max(mirror_.at(mirror_.simulated, alpha_, t), lobe)
               : lobe;
  }
  // Over a white furnace.
  double mean() const {
    constexpr int kSteps = 256;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double mu = (i + 0.5) / kSteps;
      sum += 2 * mu * at(MirrorAlbedo::warp(alpha_, mu)) / kSteps;
    }
    return std::min(sum, 1.0);
  }

 private:
  const Material& material_;
  const MirrorAlbedo& mirror_;
  double alpha_;
};

// Mean of Schlick's reflectance over a hemisphere of cosine-weighted directions.
double meanReflectance(double f0) {
  return f0 + (1 - f0) / 21;
}

// What the kernels multiply what is lost by. `mean_energy` of one bounce.
double bouncedColour(Compensation compensation, double f0, double mean_energy) {
  const double reflectance = meanReflectance(f0), q = 1 - mean_energy;
  if (compensation == Compensation::kMean || compensation == Compensation::kFdezAguera)
    return reflectance;
  if (compensation != Compensation::kKullaConty) return f0;
  // Two bounces, three, and so on, of which each but the first is one of q again.
  return reflectance * reflectance * (1 - q) /
         (std::max(1 - reflectance * q, kLeastRoom) * kPi * std::max(q, kLeastRoom));
}

// Metals: what one bounce leaves out.
void prepareCompensation(const Material& material, const KernelConfig& config,
                         const MirrorAlbedo& mirror, MultiscatterMaterial& out) {
  const double alpha = std::sqrt(static_cast<double>(material.params.surface.alpha_g.x) *
                                 material.params.surface.alpha_g.y);
  const BounceEnergy energy(material, mirror, alpha);
  const bool scaled = config.metal_compensation == MetalCompensation::kScaled;
  out.warp = static_cast<float>(MS_WARP * alpha);
  interpolateAtChebyshevPoints(
      [&](double t) { return scaled ? 1 / energy.at(t) - 1 : 1 - energy.at(t); }, out.compensation);
  const double mean = energy.mean();
  out.bounced = mapColour(material.params.surface.f0, [&](double f0) {
    return bouncedColour(material.compensation, f0, mean);
  });
  if (config.metal_compensation != MetalCompensation::kFdezAguera) return;
  const reference::Ndf ndf = material.ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann;
  interpolateAtChebyshevPoints(
      [&](double mu) {
        const SplitAlbedo albedo = specularAlbedo(ndf, mu, alpha);
        return albedo.schlick / albedo.mirror;
      },
      out.schlick);
}

}  // namespace

MultiscatterMaterial prepareMultiscatter(const Material& material, const KernelConfig& config,
                                         const MultiscatterData* data) {
  const auto fits = [data]() -> const MultiscatterData& {
    return data ? *data : multiscatterData();
  };
  const double alpha = material.diffuse_roughness;
  MultiscatterMaterial out{};
  if (config.multiscatter == Multiscatter::kPublished) prepareLobes(material, kPublishedCode, out);
  if (config.multiscatter == Multiscatter::kRefit) prepareLobes(material, fits().refit, out);
  if (config.multiscatter == Multiscatter::kEon)
    prepareEon(material.params, fits().eon.at(alpha), out);
  if (config.multiscatter == Multiscatter::kFitted)
    prepareFitted(material.params, fits().fitted.at(alpha), out);
  if (config.metal_compensation != MetalCompensation::kOff)
    prepareCompensation(material, config, fits().mirror, out);
  return out;
}

namespace {

struct AllScattering {
  Buffer buffer;
};

AllScattering uploadAll(FrameResources& frame, const KernelConfig& config) {
  std::vector<MultiscatterMaterial> scatter;
  for (const Material& material : frame.scene.materials)
    scatter.push_back(prepareMultiscatter(
        material, configFor(material, frame.scene, frame.options, config.width)));
  return {upload(frame.device, scatter, BufferPurpose::kScattering)};
}

}  // namespace

void addScattering(FrameResources& frame, const Material& material, const KernelConfig& config,
                   ShadeArguments& arguments) {
  if (config.all_materials)
    arguments.add("scatter",
                  frame.kept<AllScattering>([&] { return uploadAll(frame, config); }).buffer);
  else
    arguments.add("scatter",
                  upload(frame.device, std::vector{prepareMultiscatter(material, config)},
                         BufferPurpose::kScattering));
}

}  // namespace glintmark
