// Multiple scattering: the shading kernels' models against double precision, and white furnaces.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "host/fit/lobe_model.h"
#include "host/fit/multiscatter_data.h"
#include "host/frame/multiscatter.h"
#include "host/verify/check_groups.h"
#include "host/verify/pixel_harness.h"
#include "host/verify/tolerances.h"

namespace glintmark {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kViews = 400;    // evenly spaced in the cosine
constexpr int kAzimuths = 32;  // of the lights, which mix all azimuths between light and view

struct Model {
  const char* name;
  DiffuseModel model;
};
constexpr Model kModels[] = {{"published", DiffuseModel::kPublished},
                             {"refit", DiffuseModel::kRefit},
                             {"eon", DiffuseModel::kEon}};

struct ScatterCase {
  DiffuseModel model;
  double alpha, albedo;
  double light_cosine;
  int lights;  // of the same elevation, irradiance 1 / lights each on a surface that faces them
};

// Screen positions in fine steps: the tangent of the view's angle is (x + y / 2^16) / 64.
constexpr double kTangentStep = 1.0 / 64;

double viewCosine(const HandMadePixel& pixel) {
  const double tangent = kTangentStep * (pixel.x + pixel.y * 0x1p-16);
  return 1 / std::sqrt(1 + tangent * tangent);
}

HandMadeFrame scatterFrame(const ScatterCase& c, const KernelConfig& config) {
  HandMadeFrame frame;
  for (int i = 0; i < kViews; ++i) {
    const double mu = (i + 0.5) / kViews;
    const auto steps =
        static_cast<std::uint32_t>(std::sqrt(1 - mu * mu) / mu / kTangentStep * 0x1p16);
    HandMadePixel pixel;
    pixel.frame = flatFrame();
    pixel.x = steps >> 16;
    pixel.y = steps & 0xFFFFu;
    frame.pixels.push_back(pixel);
  }
  frame.ray_origin = {0, 0, -1};
  frame.ray_dx = {-kTangentStep, 0, 0};
  frame.ray_dy = {-kTangentStep * 0x1p-16, 0, 0};
  frame.material = simpleMaterial({0.5f, 0.5f}, {0.5f, 0.5f}, 1);
  frame.material.intensity = 0;
  const auto rho = static_cast<float>(c.albedo);
  frame.material.albedo = {rho, rho, rho, 0};
  const double sine = std::sqrt(1 - c.light_cosine * c.light_cosine);
  for (int k = 0; k < c.lights; ++k) {
    const double phi = 2 * kPi * (k + 0.25) / c.lights;
    frame.lights.push_back(
        coneLight({sine * std::cos(phi), sine * std::sin(phi), c.light_cosine}, 0, 1.0 / c.lights));
  }
  Material material;
  material.glint = frame.material;
  material.diffuse_model = c.model;
  material.diffuse_roughness = c.alpha;
  frame.scatter = prepareMultiscatter(material, config);
  return frame;
}

KernelConfig scatterConfig(DiffuseModel model, int lanes) {
  KernelConfig config;
  config.width = lanes;
  config.glint = config.size_variation = false;
  config.diffuse = true;
  config.multiscatter = static_cast<Multiscatter>(model);
  return config;
}

// Radiance towards (view, light) by the model in double precision.
std::function<double(double mu, const glm::dvec3& light)> referenceRadiance(const ScatterCase& c) {
  if (c.model == DiffuseModel::kEon)
    return [c](double mu, const glm::dvec3& light) {
      const glm::dvec3 view(std::sqrt(1 - mu * mu), 0, mu);
      const EonValue v = eonBrdf(light, view, multiscatterData().eon.at(c.alpha), c.albedo);
      return (v.single + v.multiple) * light.z;
    };
  const LobeModel model(c.model == DiffuseModel::kRefit ? multiscatterData().refit : kPublishedCode,
                        c.alpha);
  return [c, model](double mu, const glm::dvec3& light) {
    return model.energy(c.albedo, light.z, mu) / mu * light.z;
  };
}

// Every view that is not grazing, light from two elevations, smooth to rough.
Finding matchesReference(DiffuseModel model, int lanes) {
  Finding finding(kScatterTolerance);
  const KernelConfig config = scatterConfig(model, lanes);
  for (const double alpha : {0.0, 0.08, 0.8, 1.0})
    for (const double light_cosine : {0.3, 0.8}) {
      const ScatterCase c = {model, alpha, 0.85, light_cosine, 1};
      const HandMadeFrame frame = scatterFrame(c, config);
      const ShadedPixels shaded = shadePixels(frame, config);
      const glm::dvec3 light = referenceLights(frame)[0].direction;
      const auto radiance = referenceRadiance(c);
      for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
        const double mu = viewCosine(frame.pixels[i]);
        if (mu < 0.05) continue;
        const double want = radiance(mu, light);
        finding.add(std::abs(shaded.radiance[i].x - want) / want);
      }
    }
  return finding;
}

// Albedo 1: all that leaves, over what came in, is never more than 1. The worst is the excess.
Finding furnace(DiffuseModel model, int lanes) {
  Finding finding(kFurnaceTolerance);
  const KernelConfig config = scatterConfig(model, lanes);
  for (const double alpha : {0.0, 0.3, 0.8, 1.0})
    for (const double light_cosine : {0.05, 0.3, 0.7, 1.0}) {
      const HandMadeFrame frame = scatterFrame({model, alpha, 1, light_cosine, kAzimuths}, config);
      const ShadedPixels shaded = shadePixels(frame, config);
      double energy = 0;
      for (std::size_t i = 0; i < frame.pixels.size(); ++i)
        energy += shaded.radiance[i].x * viewCosine(frame.pixels[i]) * 2 * kPi / kViews;
      finding.add(energy / light_cosine - 1);
    }
  return finding;
}

// Light and view from straight up to 0 and below the horizon: nothing negative, nothing not finite.
Finding horizon(DiffuseModel model, int lanes) {
  double bad = 0;
  const KernelConfig config = scatterConfig(model, lanes);
  for (const double light_cosine : {1.0, 1e-3, 1e-7, 0.0, -0.5})
    for (const double albedo : {0.0, 1.0}) {
      HandMadeFrame frame = scatterFrame({model, 0.8, albedo, light_cosine, 4}, config);
      for (const glm::dvec3& origin : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0),
                                       glm::dvec3(1, 0, -1e-7), glm::dvec3(1, 0, 0.2)}) {
        frame.ray_origin = origin;
        for (const glm::vec3& radiance : shadePixels(frame, config).radiance)
          bad += !(std::isfinite(radiance.x) && radiance.x >= 0) || (albedo == 0 && radiance.x > 0);
      }
    }
  Finding finding(0);
  finding.add(bad);
  return finding;
}

Finding sameBits(DiffuseModel model, int lanes) {
  const KernelConfig wide = scatterConfig(model, lanes), one = scatterConfig(model, 1);
  const HandMadeFrame frame = scatterFrame({model, 0.7, 0.85, 0.6, 8}, wide);
  const ShadedPixels a = shadePixels(frame, wide), b = shadePixels(frame, one);
  double different = 0;
  for (std::size_t i = 0; i < a.radiance.size(); ++i) different += a.radiance[i] != b.radiance[i];
  Finding finding(0);
  finding.add(different);
  return finding;
}

}  // namespace

std::vector<Check> scatterChecks() {
  std::vector<Check> checks;
  for (const Model& m : kModels) {
    const auto add = [&](const char* name, const char* measure, Finding (*run)(DiffuseModel, int)) {
      checks.push_back({fmt::format("scatter/{}_{}", m.name, name), measure,
                        [run, &m](int lanes) { return run(m.model, lanes); }});
    };
    add("reference", "relative error", matchesReference);
    add("furnace", "energy that leaves - 1", furnace);
    add("horizon", "pixels NaN, infinite or negative", horizon);
    add("same_bits", "pixels that differ from one lane's", sameBits);
  }
  return checks;
}

}  // namespace glintmark
