#include "host/scene/file_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "host/core/error.h"
#include "host/core/float4.h"

namespace glintmark {
namespace {

constexpr double kLeastAlpha = 1e-3;  // a mirror has no lobe
constexpr double kDielectric = 0.04;

using MapCache = std::map<std::pair<std::string, double>, std::shared_ptr<const NormalMap>>;

std::shared_ptr<const NormalMap> loadMap(const FileMaterial& from, const SceneRequest& request,
                                         MapCache& known) {
  const std::string name = from.normal_map.empty() ? "the normal map of material " + from.name
                                                   : from.normal_map.string();
  auto& map = known[{name, from.normal_scale}];
  if (map) return map;
  if (from.normal_map.empty() ? !request.image_decoder
                              : !(request.normal_loader || request.image_loader))
    throw Error(
        fmt::format("material {} has a normal map, but this program reads no images", from.name));
  const Image image =
      from.normal_map.empty()
          ? request.image_decoder(from.normal_map_bytes, name)
          : (request.normal_loader ? request.normal_loader : request.image_loader)(from.normal_map);
  NormalMap decoded = decodeNormalMap(image, name, {.content = MapContent::kNormals});
  const auto scale = static_cast<float>(from.normal_scale);
  if (scale != 1)
    for (glm::vec3& n : decoded.normals)
      n = glm::normalize(glm::vec3(n.x * scale, n.y * scale, n.z));
  map = std::make_shared<const NormalMap>(std::move(decoded));
  return map;
}

/// Roughness along u and v; a rotation between the axes is taken to the nearer of them.
float2 alphasOf(const FileMaterial& from, std::size_t& turned) {
  const double alpha = std::clamp(from.roughness * from.roughness, kLeastAlpha, 1.0);
  const double strength = std::clamp(from.anisotropy, 0.0, 1.0);
  const double along = alpha + (1 - alpha) * strength * strength;
  const double quarter_turns = from.anisotropy_rotation_rad / (0.5 * std::numbers::pi);
  const double nearest = std::round(quarter_turns);
  if (strength > 0 && std::abs(quarter_turns - nearest) > 0.01) ++turned;
  const bool swapped = std::fmod(std::abs(nearest), 2) == 1;
  const auto a = static_cast<float>(along), b = static_cast<float>(alpha);
  return swapped ? float2{b, a} : float2{a, b};
}

}  // namespace

std::vector<Material> toMaterials(const std::vector<FileMaterial>& from,
                                  const SceneRequest& request, std::vector<std::string>& notes) {
  std::vector<Material> materials;
  std::map<std::string, std::size_t> not_used;
  std::size_t turned = 0;
  MapCache maps;
  for (const FileMaterial& one : from) {
    Material material;
    material.name = one.name;
    material.has_glints = false;
    material.ggx = true;
    material.params.surface.intensity = 1;
    material.params.surface.alpha_g = alphasOf(one, turned);
    material.params.glints.alpha_l = material.params.surface.alpha_g;
    material.params.glints.density = 1;
    const double metal = std::clamp(one.metalness, 0.0, 1.0);
    const glm::dvec3 colour = glm::clamp(one.base_colour, 0.0, 1.0);
    material.params.surface.f0 = toFloat4(glm::mix(glm::dvec3(kDielectric), colour, metal));
    material.params.surface.albedo = toFloat4(colour * (1 - metal));
    if (!one.normal_map.empty() || !one.normal_map_bytes.empty())
      material.normal_map = NormalMapSource{loadMap(one, request, maps)};
    for (const std::string& what : one.not_used) ++not_used[what];
    materials.push_back(std::move(material));
  }
  for (const auto& [what, count] : not_used)
    notes.push_back(fmt::format("{} of {} materials of the file have a {}, which is not read",
                                count, from.size(), what));
  if (turned > 0)
    notes.push_back(
        fmt::format("{} materials of the file turn their anisotropy, which lies along u or v "
                    "here",
                    turned));
  return materials;
}

}  // namespace glintmark
