#include "host/scene/import/gltf_materials.h"

#include <cmath>

namespace glintmark {
namespace {

using Json = GltfDocument::Json;

/// The object below `key`; an empty one where there is none.
const Json& objectIn(const Json& parent, const char* key) {
  static const Json kEmpty = Json::object();
  const auto found = parent.find(key);
  return found != parent.end() && found->is_object() ? *found : kEmpty;
}

const Json& metallicRoughness(const Json& material) {
  return objectIn(material, "pbrMetallicRoughness");
}

/// Fills a material's normal map from the image that a texture names.
void readNormalMap(GltfDocument& document, const Json& info, FileMaterial& out) {
  const auto index = info.find("index");
  if (index == info.end()) return;
  out.normal_scale = document.number(info, "scale", 1);
  const Json& texture = document.object("textures", *index);
  const auto source = texture.find("source");
  if (source == texture.end()) {
    out.not_used.emplace_back("a normal map in a format that glTF itself does not know");
    return;
  }
  const Json& image = document.object("images", *source);
  if (const auto view = image.find("bufferView"); view != image.end()) {
    out.normal_map_bytes = document.view(*view);
    return;
  }
  const std::string uri = document.text(image, "uri");
  out.normal_map = document.uriFile(uri);
  if (out.normal_map.empty()) out.normal_map_bytes = document.uriBytes(uri);
}

}  // namespace

GltfUv gltfUv(const GltfDocument& document, const Json& material) {
  const Json& surface = metallicRoughness(material);
  const Json* info = &objectIn(material, "normalTexture");
  if (info->empty()) info = &objectIn(surface, "baseColorTexture");
  if (info->empty()) info = &objectIn(surface, "metallicRoughnessTexture");
  GltfUv uv;
  uv.set = static_cast<int>(document.whole(*info, "texCoord", 0));
  const Json* transform = GltfDocument::extension(*info, "KHR_texture_transform");
  if (transform == nullptr) return uv;
  double scale[2] = {1, 1}, offset[2] = {0, 0};
  document.numbers(*transform, "scale", 2, scale);
  document.numbers(*transform, "offset", 2, offset);
  const double rotation = document.number(*transform, "rotation", 0);
  uv.set = static_cast<int>(document.whole(*transform, "texCoord", uv.set));
  // Counter-clockwise where v runs down.
  const double c = std::cos(rotation), s = std::sin(rotation);
  uv.matrix = glm::dmat2(c * scale[0], -s * scale[0], s * scale[1], c * scale[1]);
  uv.offset = {offset[0], offset[1]};
  return uv;
}

FileMaterial gltfMaterial(GltfDocument& document, const Json& material) {
  FileMaterial out;
  out.name = document.text(material, "name");
  const Json& surface = metallicRoughness(material);
  double colour[4] = {1, 1, 1, 1};
  document.numbers(surface, "baseColorFactor", 4, colour);
  out.base_colour = {colour[0], colour[1], colour[2]};
  out.metalness = document.number(surface, "metallicFactor", 1);
  out.roughness = document.number(surface, "roughnessFactor", 1);
  if (const Json* brushed = GltfDocument::extension(material, "KHR_materials_anisotropy")) {
    out.anisotropy = document.number(*brushed, "anisotropyStrength", 0);
    out.anisotropy_rotation_rad = document.number(*brushed, "anisotropyRotation", 0);
    if (brushed->contains("anisotropyTexture")) out.not_used.emplace_back("texture of anisotropy");
  }
  if (surface.contains("baseColorTexture")) out.not_used.emplace_back("texture of base colour");
  if (surface.contains("metallicRoughnessTexture"))
    out.not_used.emplace_back("texture of metalness and roughness");
  const Json& normals = objectIn(material, "normalTexture");
  if (!normals.empty()) readNormalMap(document, normals, out);
  return out;
}

}  // namespace glintmark
