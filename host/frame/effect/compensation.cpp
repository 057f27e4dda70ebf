// What metals lose to further bounces between their facets.
#include <algorithm>

#include "host/frame/effect/light_taps.h"
#include "host/frame/effect/scattering_params.h"
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

MetalCompensation programOf(Compensation compensation) {
  switch (compensation) {
    case Compensation::kOff:
      return MetalCompensation::kOff;
    case Compensation::kKullaConty:
      return MetalCompensation::kKullaConty;
    case Compensation::kFdezAguera:
      return MetalCompensation::kFdezAguera;
    default:
      return MetalCompensation::kScaled;
  }
}

void chooseCompensation(const ProgramCall& call, KernelConfig& config) {
  if (config.cone_lights && !call.truth)
    config.metal_compensation = programOf(call.material.compensation);
}

bool hasCompensation(const KernelConfig& config) {
  return config.metal_compensation != MetalCompensation::kOff;
}

bool compensationsAgree(const KernelConfig& a, const KernelConfig& b) {
  return !hasCompensation(a) || !hasCompensation(b) || a.metal_compensation == b.metal_compensation;
}

void chooseCompensationForAll(std::span<const KernelConfig> own, const ShadingOptions&,
                              KernelConfig& all) {
  const auto user = std::ranges::find_if(own, hasCompensation);
  all.metal_compensation =
      user != own.end() ? user->metal_compensation : MetalCompensation::kScaled;
}

// The parameters of both effects stand in one struct, which multiscatter adds where both are in,
// and so does it with the lights' taps.
void addCompensationArguments(FrameResources& frame, const Material& material,
                              const KernelConfig& config, ShadeArguments& arguments) {
  if (effectsOf(config).has(Effect::kMultiscatter)) return;
  addScattering(frame, material, config, arguments);
  if (config.metal_compensation != MetalCompensation::kScaled) addLightTaps(frame, arguments);
}

}  // namespace

const EffectModule& compensationEffect() {
  static const EffectModule module = {
      .material_calls =
          [](const Material& material) { return material.compensation != Compensation::kOff; },
      .strip_material = [](Material& material) { material.compensation = Compensation::kOff; },
      .choose = chooseCompensation,
      .agree = compensationsAgree,
      .choose_for_all = chooseCompensationForAll,
      .add_arguments = addCompensationArguments};
  return module;
}

}  // namespace glintmark
