// Mesh files of every other format, by assimp.
#pragma once
#include <filesystem>

#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// What assimp may take before it counts as stuck, in seconds of computing.
struct ImportLimits {
  double cpu_s = 0;
};

/// Every triangle of a file that assimp reads, nodes' transforms applied, instances copied. A part
/// is a material. Assimp works in a process of its own, since damaged files make it crash or never
/// end. Throws Error for what it cannot read; without limits, those that the file's size allows.
MeshSource readOther(const std::filesystem::path& file);
MeshSource readOther(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace glintmark
