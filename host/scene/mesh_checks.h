// What a mesh must hold to be drawn and shaded.
#pragma once
#include <string>

#include "host/scene/scene.h"

namespace glintmark {

/// Throws Error, naming `source` and the first offending vertex or triangle: no triangles, an index
/// out of range, a position, normal or uv that is not finite.
void checkMesh(const TriangleMesh& mesh, const std::string& source);

}  // namespace glintmark
