#include "host/scene/generators.h"
#include "host/scene/mesh_builder.h"

namespace glintmark {
MeshMaker readArcade(SceneTable& mesh) {
  return readPlane(mesh);
}
}  // namespace glintmark
