// Whole pixels of coloured materials against [ZK16] Eq. 1 in double precision: every channel, every
// factor, from the planes to the radiance.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/core/float4.h"
#include "host/frame/effect/scattering_params.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/reference/beckmann.h"
#include "host/reference/light_cone.h"
#include "host/reference/microfacet.h"
#include "host/reference/rough_metal.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr glm::dvec3 kF0(0.04, 0.5, 0.9), kAlbedo(0.7, 0.2, 0.4), kIrradiance(1, 2, 0.5);
constexpr double kIntensity = 1.5;
constexpr int kConeDirections = 4000;

// Nothing is alike in any two channels.
HandMadeFrame colouredFrame(float2 alpha, bool diffuse) {
  HandMadeFrame frame;
  frame.material = simpleMaterial(alpha, {0.01f, 0.01f}, 1);
  frame.material.surface.f0 = toFloat4(kF0);
  frame.material.surface.intensity = static_cast<float>(kIntensity);
  if (diffuse) frame.material.surface.albedo = toFloat4(kAlbedo);
  setRandomRays(frame);
  return frame;
}

KernelConfig shadingConfig(const CheckContext& context, bool diffuse, bool cone) {
  KernelConfig config;
  config.width = context.lanes;
  config.glint = config.size_variation = false;
  config.diffuse = diffuse;
  config.light_cone = cone;
  return config;
}

glm::dvec3 inFrame(const ShadingFrame& frame, const glm::dvec3& w) {
  return {glm::dot(frame.tangent, w), glm::dot(frame.bitangent, w), glm::dot(frame.normal, w)};
}

struct PixelGeometry {
  glm::dvec3 light, view;  // tangent frame
};

PixelGeometry geometryOf(const HandMadeFrame& frame, std::size_t i) {
  const reference::SurfacePixel pixel = referencePixel(frame, frame.pixels[i]);
  const glm::dvec3 light = glm::normalize(glm::dvec3(
      frame.lights[0].direction.x, frame.lights[0].direction.y, frame.lights[0].direction.z));
  return {inFrame(pixel.frame, light), inFrame(pixel.frame, pixel.view)};
}

glm::dvec3 materialF0(const HandMadeFrame& frame) {
  const float4& f = frame.material.surface.f0;
  return {f.x, f.y, f.z};
}

void setIrradiance(ConeLight& light) {
  light.irradiance = toFloat4(kIrradiance);
}

// Point lights from the zenith to the horizon; round and anisotropic lobes.
Finding points(const CheckContext& context, bool diffuse) {
  Finding finding(1);
  for (const float2 alpha : {float2{0.1f, 0.1f}, {0.5f, 0.15f}, {0.25f, 0.9f}})
    for (const double elevation_deg : {85.0, 50.0, 20.0, 4.0, -3.0})
      for (const double azimuth : {0.7, 2.9, 4.8}) {
        HandMadeFrame frame = colouredFrame(alpha, diffuse);
        frame.pixels = randomPixels(200, {});
        const double e = elevation_deg * kDegree;
        frame.lights = {coneLight(
            {std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth), std::sin(e)})};
        setIrradiance(frame.lights[0]);
        const ShadedPixels shaded =
            shadePixels(context.bench, frame, shadingConfig(context, diffuse, false));
        for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
          const PixelGeometry g = geometryOf(frame, i);
          if (g.view.z < 0.01) continue;
          const glm::dvec3 specular = reference::brdfTimesCosine(
              g.light, g.view, glm::dvec2(alpha.x, alpha.y), materialF0(frame));
          const glm::dvec3 lambert =
              diffuse ? kAlbedo * std::max(g.light.z, 0.0) / kPi : glm::dvec3(0);
          const glm::dvec3 want = kIrradiance * (kIntensity * specular + lambert);
          for (int c = 0; c < 3; ++c)
            finding.add(std::abs(shaded.radiance[i][c] - want[c]) /
                        (kMaskingTolerance * want[c] + 1e-5 * kIrradiance[c]));
        }
      }
  return finding;
}

// The same under cones, around the mirrored view, where the lobe is bright.
Finding cones(const CheckContext& context, double half_deg) {
  Finding finding(kNarrowConeTolerance);
  std::mt19937 random(8);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  for (const float2 alpha : {float2{0.1f, 0.1f}, {0.4f, 0.2f}, {0.6f, 0.6f}})
    for (int k = 0; k < 20; ++k) {
      HandMadeFrame frame = colouredFrame(alpha, true);
      frame.pixels = randomPixels(1, {});
      frame.pixels[0].frame = flatFrame();
      const double z = 0.1 + 0.9 * unit(), turn = 2 * kPi * unit(), r = std::sqrt(1 - z * z);
      frame.ray_origin = -glm::dvec3(r * std::cos(turn), r * std::sin(turn), z);
      frame.ray_dx = frame.ray_dy = glm::dvec3(0);
      const glm::dvec3 m = glm::normalize(
          glm::dvec3(0.5 * alpha.x * (unit() - 0.5), 0.5 * alpha.y * (unit() - 0.5), 1));
      const glm::dvec3 view = -frame.ray_origin;
      frame.lights = {coneLight(2 * glm::dot(view, m) * m - view, half_deg * kDegree)};
      setIrradiance(frame.lights[0]);
      const glm::vec3 got =
          shadePixels(context.bench, frame, shadingConfig(context, true, true)).radiance[0];
      const PixelGeometry g = geometryOf(frame, 0);
      const reference::Cone light = {g.light, half_deg * kDegree};
      const glm::dvec3 want =
          kIrradiance *
          (kIntensity * reference::coneRadiance(light, g.view, glm::dvec2(alpha.x, alpha.y),
                                                materialF0(frame), kConeDirections) +
           kAlbedo * reference::coneDiffuse(light, kConeDirections));
      for (int c = 0; c < 3; ++c) finding.add(std::abs(got[c] / want[c] - 1));
    }
  return finding;
}

// What metals get back is what their lobe loses: every channel by its own f0, at every view. The
// albedo is an integral over directions in double precision.
Finding compensation(const CheckContext& context) {
  Finding finding(kCompensationTolerance);
  for (const float alpha : {0.1f, 0.3f, 0.6f, 1.0f})
    for (const double z : {1.0, 0.7, 0.4, 0.2, 0.1}) {
      HandMadeFrame frame = colouredFrame({alpha, alpha}, false);
      frame.pixels = randomPixels(1, {});
      frame.pixels[0].frame = flatFrame();
      const double r = std::sqrt(1 - z * z);
      frame.ray_origin = {-r, 0, -z};
      frame.ray_dx = frame.ray_dy = glm::dvec3(0);
      frame.lights = {coneLight({-r, 0, z})};
      KernelConfig config = shadingConfig(context, false, false);
      const glm::vec3 plain = shadePixels(context.bench, frame, config).radiance[0];
      config.metal_compensation = MetalCompensation::kScaled;
      Material material;
      material.params = frame.material;
      material.compensation = Compensation::kLobe;
      frame.scatter = prepareMultiscatter(material, config);
      const glm::vec3 got = shadePixels(context.bench, frame, config).radiance[0];
      const double albedo = reference::microfacetAlbedo(reference::Ndf::kBeckmann, z, alpha);
      for (int c = 0; c < 3; ++c)
        finding.add(std::abs(got[c] / plain[c] - (1 + kF0[c] * (1 / albedo - 1))) * albedo);
    }
  return finding;
}

struct Rival {
  Compensation compensation;
  MetalCompensation program;
  reference::MetalWay way;
};

// The ways of others and of ours to give metals their energy back, at all pairs of elevations:
// every channel, the lobe included, over the light that comes in.
Finding metalWay(const CheckContext& context, const Rival& rival) {
  Finding finding(1);
  for (const float alpha : {0.1f, 0.4f, 1.0f}) {
    const reference::RoughMetal metal(alpha);
    for (const double light_z : {1.0, 0.6, 0.25, 0.05})
      for (const double z : {1.0, 0.5, 0.15}) {
        HandMadeFrame frame = colouredFrame({alpha, alpha}, false);
        frame.pixels = randomPixels(1, {});
        frame.pixels[0].frame = flatFrame();
        const double r = std::sqrt(1 - z * z), light_r = std::sqrt(1 - light_z * light_z);
        frame.ray_origin = {-r, 0, -z};
        frame.ray_dx = frame.ray_dy = glm::dvec3(0);
        const glm::dvec3 view(r, 0, z),
            light(-light_r * std::cos(1.0), light_r * std::sin(1.0), light_z);
        frame.lights = {coneLight(light)};
        KernelConfig config = shadingConfig(context, false, false);
        config.metal_compensation = rival.program;
        Material material;
        material.params = frame.material;
        material.compensation = rival.compensation;
        frame.scatter = prepareMultiscatter(material, config);
        const glm::vec3 got = shadePixels(context.bench, frame, config).radiance[0];
        // Kulla and Conty's lobe is a product of two losses over their mean, which is small where
        // the metal is smooth: an error of either grows with the other.
        const double losses = 2 - metal.mirror(z) - metal.mirror(light_z);
        const double grown =
            rival.compensation == Compensation::kKullaConty
                ? std::max(1.0, kIntensity * losses / (kPi * (1 - metal.meanMirror())))
                : 0.5;
        for (int c = 0; c < 3; ++c) {
          const double want = kIntensity * metal.brdfTimesCosine(rival.way, kF0[c], light, view);
          finding.add(std::abs(got[c] - want) /
                      (kMaskingTolerance * want + kCompensationTolerance * light_z * grown));
        }
      }
  }
  return finding;
}

constexpr Rival kMeanWay = {Compensation::kMean, MetalCompensation::kScaled,
                            reference::MetalWay::kMean};
constexpr Rival kKullaContyWay = {Compensation::kKullaConty, MetalCompensation::kKullaConty,
                                  reference::MetalWay::kKullaConty};
constexpr Rival kFdezAgueraWay = {Compensation::kFdezAguera, MetalCompensation::kFdezAguera,
                                  reference::MetalWay::kFdezAguera};

}  // namespace

std::vector<Check> shadingChecks() {
  return {{"shading/points", "error in units of its bound",
           [](const CheckContext& context) { return points(context, false); }},
          {"shading/points_diffuse", "error in units of its bound",
           [](const CheckContext& context) { return points(context, true); }},
          {"shading/cones_5deg", "relative error",
           [](const CheckContext& context) { return cones(context, 5); }},
          {"shading/cones_20deg", "relative error",
           [](const CheckContext& context) { return cones(context, 20); }},
          {"shading/compensation", "error of the energy that metals get back", compensation},
          {"shading/compensation_mean", "error in units of its bound",
           [](const CheckContext& context) { return metalWay(context, kMeanWay); }},
          {"shading/compensation_kulla_conty", "error in units of its bound",
           [](const CheckContext& context) { return metalWay(context, kKullaContyWay); }},
          {"shading/compensation_fdez_aguera", "error in units of its bound",
           [](const CheckContext& context) { return metalWay(context, kFdezAgueraWay); }}};
}

}  // namespace glintmark
