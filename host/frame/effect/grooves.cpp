// Microdetails in one dimension: grooves along u. [ZK16] Eq. 6
#include "host/frame/effect_module.h"

namespace glintmark {

const EffectModule& groovesEffect() {
  static const EffectModule module = {
      .material_calls =
          [](const Material& material) { return material.has_glints && material.has_grooves; },
      .strip_material =
          [](Material& material) {
            if (material.has_grooves) material.has_glints = material.has_grooves = false;
          },
      .choose =
          [](const ProgramCall& call, KernelConfig& config) {
            config.groove = config.glint && call.material.has_grooves;
          }};
  return module;
}

}  // namespace glintmark
