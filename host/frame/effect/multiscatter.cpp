// Rough diffuse facets among which light is scattered more than once. [PAT18]
#include <algorithm>

#include "host/frame/effect/light_taps.h"
#include "host/frame/effect/scattering_params.h"
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

bool hasLobes(const KernelConfig& config) {
  return config.multiscatter == Multiscatter::kPublished ||
         config.multiscatter == Multiscatter::kRefit;
}

// The ground truth keeps to the plain lobes.
void chooseMultiscatter(const ProgramCall& call, KernelConfig& config) {
  if (config.diffuse && config.cone_lights && !call.truth)
    config.multiscatter = static_cast<Multiscatter>(call.material.diffuse_model);
  config.lobe_masking = call.material.diffuse_masking > 0 && hasLobes(config);
}

bool hasMultiscatter(const KernelConfig& config) {
  return config.multiscatter != Multiscatter::kOff;
}

bool multiscatterAgree(const KernelConfig& a, const KernelConfig& b) {
  return !hasMultiscatter(a) || !hasMultiscatter(b) || a.multiscatter == b.multiscatter;
}

void chooseMultiscatterForAll(std::span<const KernelConfig> own, const ShadingOptions&,
                              KernelConfig& all) {
  const auto user = std::ranges::find_if(own, hasMultiscatter);
  all.multiscatter = user != own.end() ? user->multiscatter : Multiscatter::kRefit;
  all.lobe_masking = hasLobes(all);
}

void addMultiscatterArguments(FrameResources& frame, const Material& material,
                              const KernelConfig& config, ShadeArguments& arguments) {
  addScattering(frame, material, config, arguments);
  addLightTaps(frame, arguments);
}

}  // namespace

const EffectModule& multiscatterEffect() {
  static const EffectModule module = {
      .material_calls =
          [](const Material& material) { return material.diffuse_model != DiffuseModel::kLambert; },
      .strip_material = [](Material& material) { material.diffuse_model = DiffuseModel::kLambert; },
      .choose = chooseMultiscatter,
      .agree = multiscatterAgree,
      .choose_for_all = chooseMultiscatterForAll,
      .add_arguments = addMultiscatterArguments};
  return module;
}

}  // namespace glintmark
