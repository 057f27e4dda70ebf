// Normals for vertices that have none.
#pragma once
#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// Makes all normals unit. A vertex without one gets the mean of the triangles round its place,
/// each by its angle there, within its smoothing group. Counts in the notes what stays without,
/// which points up; `name` is the file's.
void smoothNormals(MeshSource& source, const std::string& name);

}  // namespace glintmark
