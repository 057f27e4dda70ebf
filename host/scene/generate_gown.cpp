#include "host/scene/generators.h"
#include "host/scene/mesh_builder.h"

namespace glintmark {
MeshMaker readGown(SceneTable& mesh) {
  return readPlane(mesh);
}
}  // namespace glintmark
