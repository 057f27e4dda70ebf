// Microdetails in two dimensions, drawn per grid cell. [ZK16]
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

// Grooves are glints to the kernels. The ground truth keeps to what glints are on average.
void chooseGlints(const ProgramCall& call, KernelConfig& config) {
  const Material& material = call.material;
  const bool area_lights = !call.scene.area_lights.empty();
  config.glint = material.has_glints && call.options.glints && !call.truth &&
                 (config.cone_lights || area_lights);
  config.area_glints = config.glint && area_lights;
  config.size_variation = config.glint && material.params.glints.size_variation > 0;
  config.count_cells = config.glint && call.options.count_cells;
  setKnobs(call.options, &KernelConfig::glint, config);
}

void chooseGlintsForAll(std::span<const KernelConfig>, const ShadingOptions& options,
                        KernelConfig& all) {
  all.size_variation = all.area_glints = true;
  setKnobs(options, &KernelConfig::glint, all);
}

}  // namespace

const EffectModule& glintsEffect() {
  static const EffectModule module = {
      .material_calls =
          [](const Material& material) { return material.has_glints && !material.has_grooves; },
      .strip_material =
          [](Material& material) {
            if (!material.has_grooves) material.has_glints = false;
          },
      .choose = chooseGlints,
      .planes = {Plane::kUInt, Plane::kVInt, Plane::kUFrac, Plane::kVFrac, Plane::kDudx,
                 Plane::kDvdx, Plane::kDudy, Plane::kDvdy},
      .choose_for_all = chooseGlintsForAll};
  return module;
}

}  // namespace glintmark
