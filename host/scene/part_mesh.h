// A mesh on its way into a scene: its triangles belong to named parts, not yet to materials.
#pragma once
#include <string>
#include <vector>

#include "host/scene/scene.h"

namespace glintmark {

struct PartMesh {
  TriangleMesh mesh;  // triangle_materials holds indices into `parts`; tangents may be empty
  std::vector<std::string> parts;
  std::vector<std::string> notes;  // what was repaired, one sentence each
};

}  // namespace glintmark
