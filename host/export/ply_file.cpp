#include "host/export/ply_file.h"

#include <fmt/format.h>

#include <bit>
#include <string>

#include "host/core/atomic_file.h"

namespace glintmark {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY files are written as memory is");

template <typename Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(Value));
}

}  // namespace

void writePly(const PlyMesh& mesh, const std::filesystem::path& path) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      mesh.positions.size());
  if (!mesh.normals.empty()) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uvs.empty()) bytes += "property float u\nproperty float v\n";
  bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                       mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    append(bytes, mesh.positions[i]);
    if (!mesh.normals.empty()) append(bytes, mesh.normals[i]);
    if (!mesh.uvs.empty()) append(bytes, mesh.uvs[i]);
  }
  for (const glm::uvec3& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    append(bytes, triangle);
  }
  writeFile(path, bytes);
}

}  // namespace glintmark
