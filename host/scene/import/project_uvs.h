// uvs for triangles that have none.
#pragma once
#include "host/scene/import/import_options.h"
#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// Gives every triangle with a corner that has no uv a projection along an axis: of the triangles
/// of its part together the one that they face most (planar), or of each triangle its own (box,
/// with seams between sides). In units of the file, or, where no triangle has uvs, in units of the
/// mesh's longest side. Triangles whose uvs have no area get planar ones that are so much smaller
/// than a pixel that microdetails show as their mean. All said in the notes; `name` is the file's.
void projectUvs(MeshSource& source, UvProjection projection, const std::string& name);

}  // namespace glintmark
