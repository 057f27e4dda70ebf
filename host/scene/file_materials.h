// Materials that a mesh file brings.
#pragma once
#include <vector>

#include "host/scene/load_scene.h"
#include "host/scene/part_mesh.h"

namespace glintmark {

/// One smooth material with GGX lobes for each of the file's: base colour and metalness become
/// albedo and reflectance, roughness and anisotropy the pair of roughnesses, and its normal map is
/// loaded. What ours cannot take is added to `notes`. Throws Error for a normal map that cannot be
/// read. [Khronos, "glTF 2.0 Specification", Appendix B; KHR_materials_anisotropy]
std::vector<Material> toMaterials(const std::vector<FileMaterial>& from,
                                  const SceneRequest& request, std::vector<std::string>& notes);

}  // namespace glintmark
