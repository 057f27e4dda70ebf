#include "host/frame/effects.h"

#include <algorithm>

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
  config.normal_method = options.truth ? NormalMethod::kFixed : options.normal_method;
  const bool gmm = config.normal_method == NormalMethod::kGmm;
  if (gmm) config.lobes = options.lobes > 0 ? options.lobes : material.normal_map->lobes;
  config.half_texels = gmm && options.half_texels;
  // Fournier's peaks are not filtered, so his method knows no anisotropic filter.
  const bool isotropic = options.truth || config.normal_method == NormalMethod::kFixed ||
                         config.normal_method == NormalMethod::kFournier;
  config.anisotropy = isotropic ? 1 : options.anisotropy;
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
  config.clipless = options.clipless;
  if (!config.normal_map) return;
  config.ltc_method = options.ltc_method;
  // Area lights read mean normals, and so do the methods mip and toksvig.
  if (config.normal_method != NormalMethod::kMip) config.normal_method = NormalMethod::kToksvig;
  config.lobes = 1;
  config.half_texels = false;
  config.anisotropy = options.anisotropy;
}

}  // namespace

KernelConfig configFor(const Material& material, const Scene& scene, const ShadingOptions& options,
                       int lanes) {
  const auto& albedo = material.glint.albedo;
  KernelConfig config;
  config.width = lanes;
  config.cone_lights = !scene.lights.empty();
  config.glint = material.has_glints && options.glints && !options.truth && config.cone_lights;
  config.groove = config.glint && material.has_grooves;
  config.glint_colour = config.glint && material.has_colour;
  config.size_variation = config.glint && material.glint.size_variation > 0;
  config.light_cone = std::ranges::any_of(
      scene.lights, [](const ConeLight& light) { return light.direction.w > 0; });
  config.diffuse = albedo.x > 0 || albedo.y > 0 || albedo.z > 0;
  config.count_cells = config.glint && options.count_cells;
  config.method = config.glint ? options.method : GlintMethod::kZk16;
  config.ka = config.glint ? options.ka : 16;
  // The ground truth of normal maps and area lights keeps to the plain lobes.
  if (config.diffuse && !options.truth)
    config.multiscatter = static_cast<Multiscatter>(material.diffuse_model);
  config.lobe_masking =
      material.diffuse_masking > 0 && (config.multiscatter == Multiscatter::kPublished ||
                                       config.multiscatter == Multiscatter::kRefit);
  config.metal_compensation = material.compensation != Compensation::kOff && !options.truth;
  setNormalMap(material, options, config);
  setAreaLights(material, scene, options, config);
  config.planes = planesFor(config);
  return config;
}

PlaneMask planesFor(const Scene& scene, const ShadingOptions& options) {
  PlaneMask planes;
  for (const Material& material : scene.materials)
    planes = planes | configFor(material, scene, options, 1).planes;
  return planes;
}

}  // namespace glintmark
