// Multiple scattering: the shading kernels' models against double precision, and white furnaces.
#include <fmt/format.h>

#include <cmath>

#include "host/core/angles.h"
#include "host/fit/lobe_model.h"
#include "host/fit/multiscatter_data.h"
#include "host/frame/effect/scattering_params.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/scatter_harness.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

// Below this cosine of the view mu^(eta - 1) no longer grows in the kernels.
constexpr double kLeastViewCosine = 0.02;
// Below this cosine of the light the kernels' masking no longer falls.
constexpr double kLeastLightCosine = 1e-6;
constexpr int kViews = 400;    // evenly spaced in the cosine
constexpr int kAzimuths = 32;  // of the lights, which mix all azimuths between light and view

struct Model {
  const char* name;
  DiffuseModel model;
};
constexpr Model kModels[] = {{"published", DiffuseModel::kPublished},
                             {"refit", DiffuseModel::kRefit},
                             {"eon", DiffuseModel::kEon},
                             {"fitted", DiffuseModel::kFitted}};

// Of the others nothing is masked.
bool hasLobes(DiffuseModel model) {
  return model == DiffuseModel::kPublished || model == DiffuseModel::kRefit;
}

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
  frame.material.surface.intensity = 0;
  const auto rho = static_cast<float>(c.albedo);
  frame.material.surface.albedo = {rho, rho, rho, 0};
  const double sine = std::sqrt(1 - c.light_cosine * c.light_cosine);
  for (int k = 0; k < c.lights; ++k) {
    const double phi = 2 * kPi * (k + 0.25) / c.lights;
    frame.lights.push_back(
        coneLight({sine * std::cos(phi), sine * std::sin(phi), c.light_cosine}, 0, 1.0 / c.lights));
  }
  Material material;
  material.params = frame.material;
  material.diffuse_model = c.model;
  material.diffuse_roughness = c.alpha;
  frame.scatter = prepareMultiscatter(material, config);
  return frame;
}

KernelConfig scatterConfig(const CheckContext& context, DiffuseModel model) {
  KernelConfig config;
  config.width = context.lanes;
  config.glint = config.size_variation = false;
  config.diffuse = true;
  config.multiscatter = static_cast<Multiscatter>(model);
  return config;
}

// Radiance over irradiance at normal incidence, in double precision.
double expectedRadiance(const Material& material, const LobeModel& lobes, const DirectionPair& d) {
  const double albedo = material.params.surface.albedo.x;
  if (material.diffuse_model == DiffuseModel::kFitted) {
    const ScatterModel model(multiscatterData().fitted.at(material.diffuse_roughness));
    const double azimuth = std::atan2(d.light.y, d.light.x) - std::atan2(d.view.y, d.view.x);
    return model.energy(albedo, d.light.z, d.view.z, azimuth) / d.view.z * d.light.z;
  }
  if (material.diffuse_model != DiffuseModel::kEon)
    return lobes.energy(albedo, d.light.z, d.view.z) / d.view.z * d.light.z;
  const double r = multiscatterData().eon.at(material.diffuse_roughness);
  const EonValue value = eonBrdf(d.light, d.view, r, albedo);
  return (value.single + value.multiple) * d.light.z;
}

// One material over all pairs: finite, not negative, black where the albedo is, and as in double
// precision, in units of the tolerance.
void addMaterial(const CheckContext& context, Finding& finding, const Material& material,
                 const std::vector<DirectionPair>& pairs) {
  LobePolynomials set = material.diffuse_model == DiffuseModel::kPublished
                            ? kPublishedCode
                            : multiscatterData().refit;
  set.masking = material.diffuse_masking;
  const LobeModel lobes(set, material.diffuse_roughness);
  const double tolerance =
      material.diffuse_masking > 0 ? kMaskedScatterTolerance : kScatterTolerance;
  const std::vector<ScatteredRadiance> probed =
      probeScatter(context.bench, pairs, material, context.lanes);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [single, multiple] = probed[i];
    const double sum = single + multiple;
    if (!(std::isfinite(sum) && single >= 0 && multiple >= 0))
      finding.require(
          false, fmt::format("alpha {}, cosines {} and {}: {} + {}", material.diffuse_roughness,
                             pairs[i].light.z, pairs[i].view.z, single, multiple));
    finding.require(material.params.surface.albedo.x > 0 || sum == 0, "black surfaces reflect");
    // One albedo is enough for the comparison: it is a factor per order.
    if (material.params.surface.albedo.x != 0.5f || pairs[i].view.z < kLeastViewCosine ||
        (pairs[i].light.z > 0 && pairs[i].light.z < kLeastLightCosine))
      continue;
    const double error = std::abs(sum - expectedRadiance(material, lobes, pairs[i]));
    const double allowed = tolerance * std::max(pairs[i].light.z, sum);
    finding.add(error == 0 ? 0 : error / allowed);  // both are 0 at the horizon
  }
}

// Dense grids of roughness, incidence, view, albedo and masking, also where the formulas have
// nothing to say.
Finding scatteringMatchesReference(const CheckContext& context, DiffuseModel model) {
  Finding finding(1);
  const std::vector<DirectionPair> pairs = denseDirections();
  for (const double alpha : {0.0, 1e-3, 0.04, 0.08, 0.12, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0})
    for (const double albedo : {0.0, 0.5, 1.0})
      for (const double masking : {0.0, 0.5, 1.0})
        if (hasLobes(model) || masking == 0)
          addMaterial(context, finding, roughMaterial(model, alpha, albedo, masking), pairs);
  return finding;
}

// Albedo 1: all that leaves, over what came in, is never more than 1. The worst is the excess.
Finding furnace(const CheckContext& context, DiffuseModel model) {
  Finding finding(kFurnaceTolerance);
  const KernelConfig config = scatterConfig(context, model);
  for (const double alpha : {0.0, 0.3, 0.8, 1.0})
    for (const double light_cosine : {0.05, 0.3, 0.7, 1.0}) {
      const HandMadeFrame frame = scatterFrame({model, alpha, 1, light_cosine, kAzimuths}, config);
      const ShadedPixels shaded = shadePixels(context.bench, frame, config);
      double energy = 0;
      for (std::size_t i = 0; i < frame.pixels.size(); ++i)
        energy += shaded.radiance[i].x * viewCosine(frame.pixels[i]) * 2 * kPi / kViews;
      finding.add(energy / light_cosine - 1);
    }
  return finding;
}

// Light and view from straight up to 0 and below the horizon: nothing negative, nothing not finite.
Finding horizon(const CheckContext& context, DiffuseModel model) {
  double bad = 0;
  const KernelConfig config = scatterConfig(context, model);
  for (const double light_cosine : {1.0, 1e-3, 1e-7, 0.0, -0.5})
    for (const double albedo : {0.0, 1.0}) {
      HandMadeFrame frame = scatterFrame({model, 0.8, albedo, light_cosine, 4}, config);
      for (const glm::dvec3& origin : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0),
                                       glm::dvec3(1, 0, -1e-7), glm::dvec3(1, 0, 0.2)}) {
        frame.ray_origin = origin;
        for (const glm::vec3& radiance : shadePixels(context.bench, frame, config).radiance)
          bad += !(std::isfinite(radiance.x) && radiance.x >= 0) || (albedo == 0 && radiance.x > 0);
      }
    }
  Finding finding(0);
  finding.add(bad);
  return finding;
}

// The models alone, and whole pixels with several lights.
Finding sameScattering(const CheckContext& context, DiffuseModel model) {
  double different = 0;
  const std::vector<DirectionPair> pairs = denseDirections();
  const Material material = roughMaterial(model, 0.6, 0.8, hasLobes(model) ? 0.7 : 0);
  const std::vector<ScatteredRadiance> one = probeScatter(context.bench, pairs, material, 1),
                                       wide = probeScatter(context.bench, pairs, material,
                                                           context.lanes);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    different += one[i].single != wide[i].single || one[i].multiple != wide[i].multiple;
  const KernelConfig wide_config = scatterConfig(context, model),
                     one_config = scatterConfig(context.withLanes(1), model);
  const HandMadeFrame frame = scatterFrame({model, 0.7, 0.85, 0.6, 8}, wide_config);
  const ShadedPixels a = shadePixels(context.bench, frame, wide_config),
                     b = shadePixels(context.bench, frame, one_config);
  for (std::size_t i = 0; i < a.radiance.size(); ++i) different += a.radiance[i] != b.radiance[i];
  Finding finding(0);
  finding.add(different);
  return finding;
}

}  // namespace

std::vector<Check> scatterChecks() {
  std::vector<Check> checks;
  for (const Model& m : kModels) {
    const auto add = [&](const char* name, const char* measure,
                         Finding (*run)(const CheckContext&, DiffuseModel)) {
      checks.push_back({fmt::format("scatter/{}_{}", m.name, name), measure,
                        [run, &m](const CheckContext& context) { return run(context, m.model); }});
    };
    add("reference", "error in units of its bound", scatteringMatchesReference);
    add("furnace", "energy that leaves - 1", furnace);
    add("horizon", "pixels NaN, infinite or negative", horizon);
    add("same_bits", "values that differ from one lane's", sameScattering);
  }
  return checks;
}

}  // namespace glintmark
