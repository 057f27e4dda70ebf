// Area lights, shaded by linearly transformed cosines. [HDHN16]
#include <algorithm>

#include "host/frame/effect/area_lights.h"
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

void chooseLtc(const ProgramCall& call, KernelConfig& config) {
  const std::vector<AreaLight>& lights = call.scene.area_lights;
  config.ltc = !lights.empty();
  if (!config.ltc) return;
  std::size_t most_vertices = 3;
  for (const AreaLight& light : lights) {
    most_vertices = std::max(most_vertices, light.vertices.size());
    config.light_shapes = config.light_shapes || light.shape != LightShape::kPolygon;
    config.light_texture = config.light_texture || !light.texture.pixels.empty();
  }
  config.light_vertices = static_cast<int>(most_vertices);
  if (call.truth) return;
  setKnobs(call.options, &KernelConfig::ltc, config);
  const float2 alpha = call.material.params.surface.alpha_g;
  config.ltc_anisotropic = !config.round_lobes && alpha.x != alpha.y;
  config.ltc_method = LtcMethod::kOriginal;  // the effect `multiscale` chooses
}

void chooseLtcForAll(std::span<const KernelConfig> own, const ShadingOptions&, KernelConfig& all) {
  if (!own.empty()) all.ggx = own.front().ggx;
  for (const KernelConfig& one : own)
    all.ltc_anisotropic = all.ltc_anisotropic || one.ltc_anisotropic;
}

AreaLightBuffers& buffersOf(FrameResources& frame) {
  return frame.kept<AreaLightBuffers>([&] {
    return AreaLightBuffers(frame.device, frame.scene, frame.eye, frame.options.ltc_table);
  });
}

}  // namespace

const EffectModule& ltcEffect() {
  static const EffectModule module = {
      .scene_calls = [](const Scene& scene) { return !scene.area_lights.empty(); },
      .strip_scene = [](Scene& scene) { scene.area_lights.clear(); },
      .choose = chooseLtc,
      .planes = {Plane::kDepth},
      .agree = [](const KernelConfig& a, const KernelConfig& b) { return a.ggx == b.ggx; },
      .choose_for_all = chooseLtcForAll,
      .add_arguments =
          [](FrameResources& frame, const Material&, const KernelConfig& config,
             ShadeArguments& arguments) { buffersOf(frame).addArguments(config, arguments); },
      .describe = [](FrameResources& frame, const KernelConfig& config,
                     FrameParams& params) { buffersOf(frame).describe(config, params); }};
  return module;
}

}  // namespace glintmark
