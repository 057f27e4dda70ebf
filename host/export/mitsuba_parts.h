// The parts of a Mitsuba scene.
#pragma once
#include <fmt/format.h>

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

/// Sets MitsubaScene::reflected_share.
void shareOutReflectance(MitsubaScene& to);
/// A BSDF of id "material_N" for each material, in order.
void writeMaterials(MitsubaScene& to);
/// A mesh for each material that has triangles.
void writeMeshes(MitsubaScene& to);
void writeLights(MitsubaScene& to);

}  // namespace glintmark
