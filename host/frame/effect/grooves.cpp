// Microdetails in one dimension: grooves along u. [ZK16] Eq. 6
#include "host/frame/effect_module.h"

namespace glintmark {

const EffectModule& groovesEffect() {
  static const EffectModule module = {
      .name = "grooves",
      .material_calls =
          [](const Material& material) { return material.has_glints && material.has_grooves; },
      .strip_material =
          [](Material& material) {
            if (material.has_grooves) material.has_glints = material.has_grooves = false;
          },
      .choose =
          [](const ProgramCall& call, KernelConfig& config) {
            config.groove = config.glint && call.material.has_grooves;
          },
      .is_in = [](const KernelConfig& config) { return config.groove; },
      .bit = EFFECT_GROOVE,
      .choose_for_all = [](std::span<const KernelConfig>, const ShadingOptions&,
                           KernelConfig& all) { all.groove = true; }};
  return module;
}

}  // namespace glintmark
