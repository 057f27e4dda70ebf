// A normal map, by default as mixtures of Gaussians. [TAN05]
#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/frame/effect/normal_maps.h"
#include "host/frame/effect_module.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

// The ground truth reads the map's finest level.
void chooseNormals(const ProgramCall& call, KernelConfig& config) {
  const auto& source = call.material.normal_map;
  config.normal_map = source.has_value();
  if (!config.normal_map) return;
  if (call.truth) {
    config.normal_method = NormalMethod::kFixed;
    return;
  }
  setKnobs(call.options, &KernelConfig::normal_map, config);
  if (readsMixture(config.normal_method))
    config.lobes = call.options.lobes > 0 ? call.options.lobes : source->lobes;
  if (config.normal_method != NormalMethod::kGmm) config.half_texels = false;
  if (config.normal_method == NormalMethod::kAnisotropic && config.lobes > kMostAnisotropicLobes)
    throw Error(fmt::format("normal method anisotropic has 1 to {} lobes, not {}",
                            kMostAnisotropicLobes, config.lobes));
  if (config.normal_method == NormalMethod::kFixed) config.anisotropy = config.probes_across = 1;
  // Fournier's peaks are not filtered but evaluated, those of each probe: no more than rows need.
  if (config.normal_method == NormalMethod::kFournier)
    config.anisotropy = config.probes_across * config.probes_across;
  else
    config.peaks = KernelConfig{}.peaks;
}

bool normalsAgree(const KernelConfig& a, const KernelConfig& b) {
  return !a.normal_map || !b.normal_map || a.lobes == b.lobes;
}

// As for a material with a map, whether the scene has one or not.
void chooseNormalsForAll(std::span<const KernelConfig> own, const ShadingOptions&,
                         KernelConfig& all) {
  const auto user = std::ranges::find(own, true, &KernelConfig::normal_map);
  if (user != own.end()) all.lobes = user->lobes;
}

const NormalTexture& textureOf(FrameResources& frame, const NormalMapSource& source,
                               const KernelConfig& config) {
  return frame.textures.get(source.map, config, frame.options.mixture_order,
                            frame.options.mixture_iterations);
}

// Layouts of all materials and the one texture that they share; without any, room that nobody
// reads.
struct SharedMap {
  Buffer layouts, texels;
};

SharedMap makeSharedMap(FrameResources& frame, const KernelConfig& config) {
  const std::vector<Material>& materials = frame.scene.materials;
  std::vector<MipTexture> layouts(materials.size());
  const NormalMapSource* shared = nullptr;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const auto& source = materials[i].normal_map;
    if (!source) continue;
    if (shared && shared->map != source->map)
      throw Error("one program for all materials needs one normal map; the scene has several");
    shared = &*source;
    textureOf(frame, *source, config).layout.read(&layouts[i], sizeof(MipTexture));
  }
  return {upload(frame.device, layouts, BufferPurpose::kNormalMapLayouts),
          shared ? textureOf(frame, *shared, config).texels
                 : upload(frame.device, std::vector<float4>{}, BufferPurpose::kNormalMaps)};
}

void addNormalsArguments(FrameResources& frame, const Material& material,
                         const KernelConfig& config, ShadeArguments& arguments) {
  if (config.all_materials) {
    const SharedMap& map = frame.kept<SharedMap>([&] { return makeSharedMap(frame, config); });
    arguments.add("map", map.layouts);
    arguments.add("map_texels", map.texels);
  } else {
    const NormalTexture& texture = textureOf(frame, *material.normal_map, config);
    arguments.add("map", texture.layout);
    arguments.add("map_texels", texture.texels);
  }
}

}  // namespace

const EffectModule& normalsEffect() {
  static const EffectModule module = {
      .material_calls = [](const Material& material) { return material.normal_map.has_value(); },
      .strip_material = [](Material& material) { material.normal_map.reset(); },
      .choose = chooseNormals,
      .planes = {Plane::kUFrac, Plane::kVFrac, Plane::kDudx, Plane::kDvdx, Plane::kDudy,
                 Plane::kDvdy},
      .agree = normalsAgree,
      .choose_for_all = chooseNormalsForAll,
      .add_arguments = addNormalsArguments};
  return module;
}

}  // namespace glintmark
