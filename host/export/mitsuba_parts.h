// The parts of a Mitsuba scene.
#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/export/xml_text.h"
#include "host/scene/scene.h"

namespace glintmark {

/// A scene.xml in the making.
struct MitsubaScene {
  const Scene& scene;
  const View& view;
  std::filesystem::path folder;
  XmlText xml{};
  std::vector<std::string> notes{};
  /// Materials reflect this share of what they ought to and lights emit its inverse: Mitsuba adds
  /// two lobes by halves, and no reflectance there is above 1.
  double reflected_share = 1;
};

/// Three numbers as Mitsuba reads them.
template <typename Rgb>
std::string rgbText(const Rgb& rgb, double scale = 1) {
  return fmt::format("{}, {}, {}", rgb.x * scale, rgb.y * scale, rgb.z * scale);
}

/// The triangles of one material that need a BSDF of their own: where uv charts are mirrored, so
/// are the bitangents of a normal map.
struct MaterialPart {
  std::uint32_t material = 0;
  bool mirrored = false;

  /// "2", "2_mirrored": part of names of files and elements.
  std::string name() const { return fmt::format("{}{}", material, mirrored ? "_mirrored" : ""); }
  bool has(const Scene& scene, std::size_t triangle) const;
};
/// Those that have triangles, by material; a material without a normal map is one part.
std::vector<MaterialPart> materialParts(const Scene& scene);

/// Sets MitsubaScene::reflected_share.
void shareOutReflectance(MitsubaScene& to);
/// A BSDF of id "material_NAME" for each part.
void writeMaterials(MitsubaScene& to);
/// A mesh for each part.
void writeMeshes(MitsubaScene& to);
void writeLights(MitsubaScene& to);

}  // namespace glintmark
