#include "host/frame/effects.h"

#include <algorithm>

namespace glintmark {

PlaneMask planesFor(const KernelConfig& config) {
  PlaneMask planes = {Plane::kPixel, Plane::kFrame0, Plane::kFrame1};
  if (config.glint)
    planes = planes | PlaneMask{Plane::kUInt, Plane::kVInt, Plane::kUFrac, Plane::kVFrac,
                                Plane::kDudx, Plane::kDvdx, Plane::kDudy,  Plane::kDvdy};
  return planes;
}

KernelConfig configFor(const Material& material, const Scene& scene, const ShadingOptions& options,
                       int lanes) {
  const auto& albedo = material.glint.albedo;
  KernelConfig config;
  config.width = lanes;
  config.glint = material.has_glints && options.glints;
  config.groove = config.glint && material.has_grooves;
  config.glint_colour = config.glint && material.has_colour;
  config.size_variation = config.glint && material.glint.size_variation > 0;
  config.light_cone = std::ranges::any_of(
      scene.lights, [](const ConeLight& light) { return light.direction.w > 0; });
  config.diffuse = albedo.x > 0 || albedo.y > 0 || albedo.z > 0;
  config.count_cells = config.glint && options.count_cells;
  config.method = config.glint ? options.method : GlintMethod::kZk16;
  config.ka = config.glint ? options.ka : 16;
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
