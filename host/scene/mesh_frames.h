// Tangent frames from texture coordinates.
#pragma once
#include "host/scene/scene.h"

namespace glintmark {

/// Fills mesh.tangents: per vertex, dP/du of its triangles weighted by their area, made orthogonal
/// to the normal; w is -1 where uvs are mirrored. A vertex shared by mirrored and other triangles
/// is split, so that neither gets the other's handedness. Triangles without uv area add nothing; a
/// vertex that only they touch gets any tangent that fits its normal.
void computeTangents(TriangleMesh& mesh);

}  // namespace glintmark
