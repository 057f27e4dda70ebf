// From what a file holds to a mesh that can be drawn.
#pragma once
#include "host/scene/import/import_options.h"
#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// Drops triangles without area, joins vertices that are alike, drops those that no triangle names,
/// makes the uvs and normals that are missing and, with options.place_freely, moves and scales the
/// mesh to where floats hold it. All of it is said in the notes. Throws Error, naming
/// `source_name`, for a mesh without triangles, indices out of range, positions or uvs that are not
/// finite.
PartMesh finishMesh(MeshSource source, const std::string& source_name,
                    const ImportOptions& options);

}  // namespace glintmark
