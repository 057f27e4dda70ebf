// Stanford PLY files.
#pragma once
#include <string>

#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// The polygons and triangle strips of a PLY file, text or binary of either byte order. uvs are
/// those of its vertices (u v, s t, texture_u texture_v) or of its faces' corners (texcoord).
/// `source` names the file. Throws Error saying what is wrong where. [Turk, "The PLY Polygon File
/// Format"]
MeshSource readPly(std::string text, const std::string& source);

}  // namespace glintmark
