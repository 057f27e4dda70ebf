// Mesh files: OBJ, glTF, PLY and whatever else assimp reads.
#pragma once
#include <filesystem>

#include "host/scene/import/import_options.h"
#include "host/scene/part_mesh.h"

namespace glintmark {

/// Reads every triangle of a file, its nodes' transforms applied, instances copied, in the file's
/// order. A part is a material of the file. Normals that are missing are made, geometry without uvs
/// gets a projection and triangles without area are left out, each said in the notes. uvs lie as
/// maps do, row 0 of a picture at v = 0, whichever way v runs in the file. Throws Error for a file
/// that cannot be read, has no triangles, or holds what is not finite or not there.
PartMesh importMesh(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace glintmark
