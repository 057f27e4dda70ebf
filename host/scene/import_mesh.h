// Mesh files: OBJ, glTF, PLY and whatever else assimp reads.
#pragma once
#include <filesystem>

#include "host/scene/part_mesh.h"

namespace glintmark {

/// Reads every triangle of a file, its nodes' transforms applied, instances copied, in the file's
/// order. A part is a material of the file; missing normals are made smooth. Geometry without uvs
/// in a file that has some gets a planar projection, said in the notes. Images that the file names
/// are not looked at. Throws Error for a file that cannot be read, has no triangles or no uvs at
/// all, and for what checkMesh finds.
PartMesh importMesh(const std::filesystem::path& file);

}  // namespace glintmark
