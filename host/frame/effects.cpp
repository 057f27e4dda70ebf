#include "host/frame/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host/core/error.h"

namespace glintmark {

PlaneMask planesFor(const KernelConfig& config) {
  PlaneMask planes = {Plane::kPixel, Plane::kFrame0, Plane::kFrame1};
  if (config.glint)
    planes = planes | PlaneMask{Plane::kUInt, Plane::kVInt, Plane::kUFrac, Plane::kVFrac,
                                Plane::kDudx, Plane::kDvdx, Plane::kDudy,  Plane::kDvdy};
  if (config.normal_map)
    planes = planes | PlaneMask{Plane::kUFrac, Plane::kVFrac, Plane::kDudx,
                                Plane::kDvdx,  Plane::kDudy,  Plane::kDvdy};
  if (config.ltc) planes = planes | PlaneMask{Plane::kDepth};
  return planes;
}

namespace {

// What the kernel makes of a material's normal map; the ground truth reads its finest level.
void setNormalMap(const Material& material, const ShadingOptions& options, KernelConfig& config) {
  config.normal_map = material.normal_map.has_value();
  if (!config.normal_map) return;
  if (options.truth) {
    config.normal_method = NormalMethod::kFixed;
    return;
  }
  setKnobs(options, &KernelConfig::normal_map, config);
  if (config.normal_method == NormalMethod::kGmm)
    config.lobes = options.lobes > 0 ? options.lobes : material.normal_map->lobes;
  else
    config.half_texels = false;
  // Fournier's peaks are not filtered, so his method knows no anisotropic filter.
  if (config.normal_method == NormalMethod::kFixed ||
      config.normal_method == NormalMethod::kFournier)
    config.anisotropy = 1;
}

// What the scene's area lights call for.
void setAreaLights(const Material& material, const Scene& scene, const ShadingOptions& options,
                   KernelConfig& config) {
  config.ltc = !scene.area_lights.empty();
  if (!config.ltc) return;
  config.ggx = material.ggx;
  std::size_t most_vertices = 3;
  for (const AreaLight& light : scene.area_lights) {
    most_vertices = std::max(most_vertices, light.vertices.size());
    config.light_texture = config.light_texture || !light.texture.pixels.empty();
  }
  config.light_vertices = static_cast<int>(most_vertices);
  if (options.truth) return;
  setKnobs(options, &KernelConfig::ltc, config);
  if (!config.normal_map) {
    config.ltc_method = LtcMethod::kOriginal;  // nothing varies below a pixel
    return;
  }
  // Area lights read mean normals, and so do the methods mip and toksvig.
  if (config.normal_method != NormalMethod::kMip) config.normal_method = NormalMethod::kToksvig;
  config.lobes = 1;
  config.half_texels = false;
  config.anisotropy = options.anisotropy;
}

}  // namespace

KernelConfig configFor(const Material& material, const Scene& scene, const ShadingOptions& options,
                       int lanes) {
  const auto& albedo = material.params.surface.albedo;
  KernelConfig config;
  config.width = lanes;
  config.cone_lights = !scene.lights.empty();
  config.glint = material.has_glints && options.glints && !options.truth && config.cone_lights;
  config.groove = config.glint && material.has_grooves;
  config.glint_colour = config.glint && material.has_colour;
  config.size_variation = config.glint && material.params.glints.size_variation > 0;
  config.light_cone = std::ranges::any_of(
      scene.lights, [](const ConeLight& light) { return light.direction.w > 0; });
  config.diffuse = albedo.x > 0 || albedo.y > 0 || albedo.z > 0;
  config.count_cells = config.glint && options.count_cells;
  setKnobs(options, &KernelConfig::glint, config);
  if (!options.truth) setKnobs(options, kEveryProgram, config);
  // The ground truth of normal maps and area lights keeps to the plain lobes.
  if (config.diffuse && config.cone_lights && !options.truth)
    config.multiscatter = static_cast<Multiscatter>(material.diffuse_model);
  config.lobe_masking =
      material.diffuse_masking > 0 && (config.multiscatter == Multiscatter::kPublished ||
                                       config.multiscatter == Multiscatter::kRefit);
  config.metal_compensation =
      material.compensation != Compensation::kOff && config.cone_lights && !options.truth;
  setNormalMap(material, options, config);
  setAreaLights(material, scene, options, config);
  config.planes = planesFor(config);
  return config;
}

uint effectBits(const KernelConfig& config) {
  return (config.glint ? EFFECT_GLINT : 0) | (config.groove ? EFFECT_GROOVE : 0) |
         (config.glint_colour ? EFFECT_GLINT_COLOUR : 0) | (config.diffuse ? EFFECT_DIFFUSE : 0) |
         (config.normal_map ? EFFECT_NORMAL_MAP : 0) | (config.ltc ? EFFECT_LTC : 0) |
         (config.multiscatter != Multiscatter::kOff ? EFFECT_MULTISCATTER : 0) |
         (config.metal_compensation ? EFFECT_METAL_COMPENSATION : 0);
}

KernelConfig configForAll(const Scene& scene, const ShadingOptions& options, int lanes) {
  if (options.count_cells || options.truth)
    throw Error("one program for all materials neither counts cells nor makes the ground truth");
  // A smooth material with a normal map, for scenes that have none.
  Material mapped;
  mapped.has_glints = false;
  mapped.normal_map.emplace();
  KernelConfig all = configFor(mapped, scene, options, lanes);
  std::optional<KernelConfig> map_user, scatterer;
  for (const Material& material : scene.materials) {
    const KernelConfig config = configFor(material, scene, options, lanes);
    if (&material == &scene.materials.front()) all.ggx = config.ggx;
    if (config.normal_map && !map_user) map_user = config;
    if (config.multiscatter != Multiscatter::kOff && !scatterer) scatterer = config;
    const bool alike = config.ggx == all.ggx &&
                       (!config.normal_map || config.lobes == map_user->lobes) &&
                       (config.multiscatter == Multiscatter::kOff ||
                        config.multiscatter == scatterer->multiscatter);
    if (!alike)
      throw Error(fmt::format(
          "one program for all materials needs one NDF, one number of lobes and one model of "
          "multiple scattering; material '{}' has another than those before it",
          material.name));
  }
  if (map_user) all.lobes = map_user->lobes;
  all.all_materials = all.glint = all.groove = all.glint_colour = all.size_variation = true;
  all.cone_lights = all.diffuse = all.ltc = all.metal_compensation = true;
  setKnobs(options, &KernelConfig::glint, all);
  all.ltc_method = options.ltc_method;
  all.multiscatter = scatterer ? scatterer->multiscatter : Multiscatter::kRefit;
  all.lobe_masking =
      all.multiscatter == Multiscatter::kPublished || all.multiscatter == Multiscatter::kRefit;
  all.planes = planesFor(all);
  return all;
}

PlaneMask planesFor(const Scene& scene, const ShadingOptions& options) {
  if (options.programs != Programs::kPerMaterial) return configForAll(scene, options, 1).planes;
  PlaneMask planes;
  for (const Material& material : scene.materials)
    planes = planes | configFor(material, scene, options, 1).planes;
  return planes;
}

}  // namespace glintmark
