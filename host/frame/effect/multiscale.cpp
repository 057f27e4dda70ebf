// Area lights that see how the normals vary below a pixel. [TAO21]
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

void chooseMultiscale(const ProgramCall& call, KernelConfig& config) {
  if (call.truth || !config.ltc || !config.normal_map) return;
  config.ltc_method = call.options.ltc_method;
  // Area lights read mean normals, and so do the methods mip and toksvig.
  if (config.normal_method != NormalMethod::kMip) config.normal_method = NormalMethod::kToksvig;
  config.lobes = 1;
  config.half_texels = false;
  config.anisotropy = call.options.anisotropy;
  config.probes_across = call.options.probes_across;
  config.peaks = KernelConfig{}.peaks;
}

}  // namespace

const EffectModule& multiscaleEffect() {
  static const EffectModule module = {
      .needs = {Effect::kNormals, Effect::kLtc},
      .strip_options = [](ShadingOptions& options) { options.ltc_method = LtcMethod::kOriginal; },
      .choose = chooseMultiscale,
      .is_in = [](const KernelConfig& config) { return config.ltc && config.normal_map; },
      .choose_for_all = [](std::span<const KernelConfig>, const ShadingOptions& options,
                           KernelConfig& all) { all.ltc_method = options.ltc_method; }};
  return module;
}

}  // namespace glintmark
