// What metals lose to further bounces between their facets.
#include "host/frame/effect/scattering_params.h"
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

void chooseCompensation(const ProgramCall& call, KernelConfig& config) {
  config.metal_compensation =
      call.material.compensation != Compensation::kOff && config.cone_lights && !call.truth;
}

// The parameters of both effects stand in one struct, which multiscatter adds where both are in.
void addCompensationArguments(FrameResources& frame, const Material& material,
                              const KernelConfig& config, ShadeArguments& arguments) {
  if (!effectsOf(config).has(Effect::kMultiscatter))
    addScattering(frame, material, config, arguments);
}

}  // namespace

const EffectModule& compensationEffect() {
  static const EffectModule module = {
      .material_calls =
          [](const Material& material) { return material.compensation != Compensation::kOff; },
      .strip_material = [](Material& material) { material.compensation = Compensation::kOff; },
      .choose = chooseCompensation,
      .add_arguments = addCompensationArguments};
  return module;
}

}  // namespace glintmark
