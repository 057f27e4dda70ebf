// Stereolithography files, binary and text.
#pragma once
#include <filesystem>

#include "host/scene/import/mesh_source.h"

namespace glintmark {

/// Triangles of an STL file, read in pieces. The format has no vertices, so corners at one place
/// are one vertex where their triangles lie within kStlCrease_deg of the first of them; normals are
/// made from the triangles, those of the file do not count. Parts are the solids of a text. Throws
/// Error for a file that ends within a triangle. [3D Systems, "StereoLithography Interface
/// Specification", 1989]
MeshSource readStl(const std::filesystem::path& file);

/// Triangles that meet at a larger angle keep an edge.
inline constexpr double kStlCrease_deg = 30;

}  // namespace glintmark
