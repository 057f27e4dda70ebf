// A mesh on its way into a scene: its triangles belong to named parts, not yet to materials.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/scene/scene.h"

namespace glintmark {

/// What a file says of a material. Colours are linear.
struct FileMaterial {
  std::string name;
  glm::dvec3 base_colour{1};
  double metalness = 1, roughness = 1;  // [0, 1]; roughness as artists have it, the root of alpha
  double anisotropy = 0, anisotropy_rotation_rad = 0;  // [0, 1]; from u towards v
  std::filesystem::path normal_map{};  // empty for none and for one in the mesh file
  std::string normal_map_bytes{};      // of a picture that the mesh file holds
  double normal_scale = 1;
  std::vector<std::string> not_used{};  // what ours cannot take
};

struct PartMesh {
  TriangleMesh mesh;  // triangle_materials holds indices into `parts`; tangents may be empty
  std::vector<std::string> parts;
  std::vector<FileMaterial> materials{};  // of the first parts, where they were asked for
  std::vector<std::string> notes{};       // what was repaired, one sentence each
};

}  // namespace glintmark
