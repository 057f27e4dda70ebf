// Materials by their nearest BSDF: roughconductor, diffuse, normalmap, blendbsdf, twosided.
#include <algorithm>
#include <cmath>

#include "host/export/mitsuba_parts.h"
#include "host/report/picture/image_io.h"

namespace glintmark {
namespace {

// From here on a surface mirrors everything at any angle.
constexpr float kWhole = 0.999f;

bool isBlack(const float4& rgb) {
  return std::max({rgb.x, rgb.y, rgb.z}) <= 0;
}

bool hasDiffuse(const Material& material) {
  return !isBlack(material.params.surface.albedo);
}

bool hasSpecular(const Material& material) {
  const SurfaceMaterial& surface = material.params.surface;
  return surface.intensity > 0 && !isBlack(surface.f0);
}

// Of a surface without absorption that mirrors the share f0 of what comes along its normal.
double indexOf(float f0) {
  const double root = std::sqrt(std::clamp(static_cast<double>(f0), 1e-6, 0.9999));
  return (1 + root) / (1 - root);
}

void writeDiffuse(MitsubaScene& to, const float4& albedo, double share) {
  to.xml.open("bsdf", {{"type", "diffuse"}});
  to.xml.leaf("rgb", {{"name", "reflectance"}, {"value", rgbText(albedo, share)}});
  to.xml.close();
}

void writeSpecular(MitsubaScene& to, const Material& material, double share) {
  const SurfaceMaterial& surface = material.params.surface;
  const float4& f0 = surface.f0;
  glm::dvec2 alpha(surface.alpha_g.x, surface.alpha_g.y);
  if (to.scene.lights.empty()) alpha = glm::dvec2(std::sqrt(alpha.x * alpha.y));
  to.xml.open("bsdf", {{"type", "roughconductor"}});
  to.xml.leaf("string", {{"name", "distribution"}, {"value", material.ggx ? "ggx" : "beckmann"}});
  to.xml.leaf("float", {{"name", "alpha_u"}, {"value", fmt::format("{}", alpha.x)}});
  to.xml.leaf("float", {{"name", "alpha_v"}, {"value", fmt::format("{}", alpha.y)}});
  if (std::min({f0.x, f0.y, f0.z}) >= kWhole) {
    to.xml.leaf("string", {{"name", "material"}, {"value", "none"}});
  } else {
    to.xml.leaf(
        "rgb", {{"name", "eta"},
                {"value", fmt::format("{}, {}, {}", indexOf(f0.x), indexOf(f0.y), indexOf(f0.z))}});
    to.xml.leaf("rgb", {{"name", "k"}, {"value", "0, 0, 0"}});
  }
  const double scale = surface.intensity * share;
  to.xml.leaf("rgb",
              {{"name", "specular_reflectance"}, {"value", fmt::format("{0}, {0}, {0}", scale)}});
  to.xml.close();
}

// Both lobes, each by half where some material has both.
void writeLobes(MitsubaScene& to, const Material& material, bool by_halves) {
  const double share = to.reflected_share * (by_halves ? 2 : 1);
  if (by_halves) {
    to.xml.open("bsdf", {{"type", "blendbsdf"}});
    to.xml.leaf("float", {{"name", "weight"}, {"value", "0.5"}});
  }
  if (by_halves || !hasSpecular(material)) writeDiffuse(to, material.params.surface.albedo, share);
  if (hasSpecular(material))
    writeSpecular(to, material, share);
  else if (by_halves)
    writeDiffuse(to, {0, 0, 0, 0}, 1);
  if (by_halves) to.xml.close();
}

// Opens a BSDF around the lobes.
void openNormalMap(MitsubaScene& to, const NormalMap& map, const MaterialPart& part) {
  const std::string name = fmt::format("normals_{}.exr", part.name());
  Image image(map.width_px, map.height_px, 3);
  for (std::size_t i = 0; i < map.normals.size(); ++i) {
    const glm::vec3 n = map.normals[i] * glm::vec3(1, part.mirrored ? -1 : 1, 1);
    for (int c = 0; c < 3; ++c)
      image.pixels[3 * i + static_cast<std::size_t>(c)] = 0.5f * (n[c] + 1);
  }
  writeExr(image, to.folder / name);
  to.xml.open("bsdf", {{"type", "normalmap"}});
  // As here: a normal that turns from the eye is no other, and light is cut at its horizon alone.
  to.xml.leaf("boolean", {{"name", "flip_invalid_normals"}, {"value", "false"}});
  to.xml.leaf("boolean", {{"name", "use_shadowing_function"}, {"value", "false"}});
  to.xml.open("texture", {{"name", "normalmap"}, {"type", "bitmap"}});
  to.xml.leaf("string", {{"name", "filename"}, {"value", name}});
  to.xml.leaf("boolean", {{"name", "raw"}, {"value", "true"}});
  to.xml.leaf("string", {{"name", "wrap_mode"}, {"value", "repeat"}});
  to.xml.close();
}

// What the BSDF does not say of the material.
void noteMaterial(MitsubaScene& to, const Material& material) {
  const auto note = [&](const char* what) {
    to.notes.push_back(fmt::format("material {}: {}", material.name, what));
  };
  if (material.has_glints) note("microdetails are the smooth lobe that they average to");
  if (material.has_colour) note("colours of microdetails are left out");
  if (material.diffuse_model != DiffuseModel::kLambert) note("its rough diffuse lobe is Lambert's");
  if (material.compensation != Compensation::kOff && hasSpecular(material))
    note("light of further bounces between facets is left out");
  if (!hasSpecular(material)) return;
  note("masking and shadowing are independent, here they are correlated by height");
  const float4& f0 = material.params.surface.f0;
  if (std::min({f0.x, f0.y, f0.z}) < kWhole)
    note("Fresnel's term is exact for an index that has the same f0, here it is Schlick's");
  const float4& albedo = material.params.surface.albedo;
  if (std::max({albedo.x, albedo.y, albedo.z}) > 0)
    note("its diffuse layer gets all of the light, here what the lobe above it leaves");
  if (material.normal_map)
    note("mapped normals that turn from the eye are black, here they scatter diffuse light");
  const float2& alpha = material.params.surface.alpha_g;
  if (!to.scene.area_lights.empty() && !to.scene.lights.empty() && alpha.x != alpha.y)
    note("its roughness is anisotropic under area lights too, where it is round here");
}

bool byHalves(const Scene& scene) {
  return std::ranges::any_of(scene.materials, [](const Material& material) {
    return hasDiffuse(material) && hasSpecular(material);
  });
}

}  // namespace

void shareOutReflectance(MitsubaScene& to) {
  float most = 1;
  for (const Material& material : to.scene.materials)
    most = std::max(most, material.params.surface.intensity);
  to.reflected_share = 1 / (most * (byHalves(to.scene) ? 2.0 : 1.0));
}

void writeMaterials(MitsubaScene& to) {
  const bool by_halves = byHalves(to.scene);
  std::uint32_t noted = 0;
  for (const MaterialPart& part : materialParts(to.scene)) {
    const Material& material = to.scene.materials[part.material];
    to.xml.open("bsdf", {{"type", "twosided"}, {"id", "material_" + part.name()}});
    if (material.normal_map) openNormalMap(to, *material.normal_map->map, part);
    writeLobes(to, material, by_halves);
    if (material.normal_map) to.xml.close();
    to.xml.close();
    if (part.material >= noted) noteMaterial(to, material);
    noted = part.material + 1;
  }
}

}  // namespace glintmark
