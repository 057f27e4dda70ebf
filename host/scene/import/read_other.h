// Mesh files of every other format, by assimp.
#pragma once
#include <filesystem>

#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// Every triangle of a file that assimp reads, nodes' transforms applied, instances copied. A part
/// is a material. Throws Error for what it cannot read.
MeshSource readOther(const std::filesystem::path& file);

}  // namespace glintmark
