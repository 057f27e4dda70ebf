// glTF and GLB files.
#pragma once
#include <filesystem>

#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// Triangles of the file's scene (its default one, else the first, else all nodes), instances
/// copied, transforms applied; a part is a material. Meshes without normals are flat, as glTF asks.
/// Morph targets stand at their default weights and skins in the pose they were bound in, both said
/// in the notes. With `wants_materials` materials and the bytes of embedded normal maps are read
/// too. Throws Error naming the file and what in it is wrong.
MeshSource readGltf(const std::filesystem::path& file, bool wants_materials);

}  // namespace glintmark
