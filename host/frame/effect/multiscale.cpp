// Area lights that see how the normals vary below a pixel. [TAO21]
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

int lobesOf(const ProgramCall& call) {
  return call.options.lobes > 0 ? call.options.lobes : call.material.normal_map->lobes;
}

void chooseMultiscale(const ProgramCall& call, KernelConfig& config) {
  if (call.truth || !config.ltc || !config.normal_map) return;
  config.ltc_method = call.options.ltc_method;
  if (config.ltc_method == LtcMethod::kMixture) {
    // Both kinds of lights read mixtures then, and area lights round lobes.
    config.ltc_anisotropic = false;
    config.normal_method = NormalMethod::kGmm;
    config.lobes = lobesOf(call);
    config.half_texels = call.options.half_texels;
    config.anisotropy = call.options.anisotropy;
    config.probes_across = call.options.probes_across;
    return;
  }
  config.anisotropy = call.options.anisotropy;
  config.probes_across = call.options.probes_across;
  config.lobes = 1;
  config.half_texels = false;
  config.peaks = KernelConfig{}.peaks;
  if (config.ltc_method == LtcMethod::kCovariance) {
    config.normal_method = NormalMethod::kLean;
    config.ltc_anisotropic = true;
    config.round_lobes = false;
    return;
  }
  // Area lights read mean normals, and so do the methods mip and toksvig.
  if (config.normal_method != NormalMethod::kMip) config.normal_method = NormalMethod::kToksvig;
}

}  // namespace

const EffectModule& multiscaleEffect() {
  static const EffectModule module = {
      .needs = {Effect::kNormals, Effect::kLtc},
      .strip_options = [](ShadingOptions& options) { options.ltc_method = LtcMethod::kOriginal; },
      .choose = chooseMultiscale,
      .is_in = [](const KernelConfig& config) { return config.ltc && config.normal_map; },
      .choose_for_all =
          [](std::span<const KernelConfig>, const ShadingOptions& options, KernelConfig& all) {
            all.ltc_method = options.ltc_method;
            if (all.ltc_method == LtcMethod::kMixture) all.ltc_anisotropic = false;
            if (all.ltc_method == LtcMethod::kCovariance) {
              all.ltc_anisotropic = true;
              all.round_lobes = false;
            }
          }};
  return module;
}

}  // namespace glintmark
