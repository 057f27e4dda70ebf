#include "host/frame/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

// Switches of a program that shades frames, or samples the ground truth.
KernelConfig chosenConfig(const ProgramCall& call, int lanes) {
  const auto& albedo = call.material.params.surface.albedo;
  KernelConfig config;
  config.width = lanes;
  config.cone_lights = !call.scene.lights.empty();
  config.light_cone = std::ranges::any_of(
      call.scene.lights, [](const ConeLight& light) { return light.direction.w > 0; });
  config.ggx = call.material.ggx;
  config.diffuse = albedo.x > 0 || albedo.y > 0 || albedo.z > 0;
  config.albedo_scaling = config.diffuse && call.material.params.surface.intensity > 0;
  if (!call.truth) setKnobs(call.options, kEveryProgram, config);
  for (const EffectModule* module : effectModules())
    if (module->choose) module->choose(call, config);
  // Microdetails and maps have no wider lobe: the mesh's curvature is not theirs.
  if (!call.truth && !config.glint && !config.normal_map)
    setKnobs(call.options, &KernelConfig::cone_lights, config);
  if (!call.truth) setKnobs(call.options, &KernelConfig::light_cone, config);
  config.planes = planesFor(config);
  return config;
}

// Throws Error naming the first material whose choices differ from those of one before it.
void requireAgreement(const Scene& scene, std::span<const KernelConfig> own) {
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t before = 0; before < i; ++before)
      for (const EffectModule* module : effectModules())
        if (module->agree && !module->agree(own[before], own[i]))
          throw Error(fmt::format(
              "one program for all materials needs one NDF, one number of lobes and one model of "
              "multiple scattering; material '{}' has another than those before it",
              scene.materials[i].name));
}

}  // namespace

PlaneMask planesFor(const KernelConfig& config) {
  PlaneMask planes = {Plane::kPixel, Plane::kFrame0, Plane::kFrame1};
  for (const Effect effect : effectsOf(config).list())
    planes = planes | effectModule(effect).planes;
  if (config.geometric_aa != GeometricAa::kNone) planes = planes | kNormalSteps;
  return planes;
}

KernelConfig configFor(const Material& material, const Scene& scene, const ShadingOptions& options,
                       int lanes) {
  return chosenConfig({material, scene, options}, lanes);
}

KernelConfig truthConfigFor(const Material& material, const Scene& scene,
                            const ShadingOptions& options, int lanes) {
  return chosenConfig({material, scene, options, true}, lanes);
}

KernelConfig configForAll(const Scene& scene, const ShadingOptions& options, int lanes) {
  if (options.count_cells) throw Error("one program for all materials does not count cells");
  if (options.geometric_aa != GeometricAa::kNone)
    throw Error("one program for all materials knows no geometric antialiasing but none");
  std::vector<KernelConfig> own;
  for (const Material& material : scene.materials)
    own.push_back(configFor(material, scene, options, lanes));
  requireAgreement(scene, own);
  // From a smooth material with a normal map, for scenes that have none.
  Material mapped;
  mapped.has_glints = false;
  mapped.normal_map.emplace();
  KernelConfig all = configFor(mapped, scene, options, lanes);
  all.all_materials = all.cone_lights = all.diffuse = all.albedo_scaling = true;
  for (const Effect effect : EffectSet::all().list()) {
    turnOn(effect, all);
    if (const EffectModule& module = effectModule(effect); module.choose_for_all)
      module.choose_for_all(own, options, all);
  }
  all.planes = planesFor(all);
  return all;
}

PlaneMask planesFor(const Scene& scene, const ShadingOptions& options) {
  if (options.programs != Programs::kPerMaterial) return configForAll(scene, options, 1).planes;
  PlaneMask planes;
  for (const Material& material : scene.materials)
    planes = planes | configFor(material, scene, options, 1).planes;
  return planes;
}

PlaneMask truthPlanesFor(const Scene& scene, const ShadingOptions& options) {
  PlaneMask planes;
  for (const Material& material : scene.materials)
    planes = planes | truthConfigFor(material, scene, options, 1).planes;
  return planes;
}

}  // namespace glintmark
