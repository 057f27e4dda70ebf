// A colour for each microdetail. [ZK16] Sect. 4.5
#include "host/frame/effect_module.h"

namespace glintmark {

const EffectModule& colourEffect() {
  static const EffectModule module = {
      .needs = {Effect::kGlints},
      .material_calls =
          [](const Material& material) {
            return material.has_glints && !material.has_grooves && material.has_colour;
          },
      .strip_material = [](Material& material) { material.has_colour = false; },
      .choose =
          [](const ProgramCall& call, KernelConfig& config) {
            config.glint_colour = config.glint && call.material.has_colour;
          }};
  return module;
}

}  // namespace glintmark
