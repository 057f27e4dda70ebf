// A colour for each microdetail. [ZK16] Sect. 4.5
#include "host/frame/effect_module.h"

namespace glintmark {

const EffectModule& colourEffect() {
  static const EffectModule module = {
      .name = "colour",
      .needs = {Effect::kGlints},
      .material_calls =
          [](const Material& material) {
            return material.has_glints && !material.has_grooves && material.has_colour;
          },
      .strip_material = [](Material& material) { material.has_colour = false; },
      .choose =
          [](const ProgramCall& call, KernelConfig& config) {
            config.glint_colour = config.glint && call.material.has_colour;
          },
      .is_in = [](const KernelConfig& config) { return config.glint_colour; },
      .bit = EFFECT_GLINT_COLOUR,
      .choose_for_all = [](std::span<const KernelConfig>, const ShadingOptions&,
                           KernelConfig& all) { all.glint_colour = true; }};
  return module;
}

}  // namespace glintmark
