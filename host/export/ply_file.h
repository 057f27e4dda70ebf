// Triangles as PLY files, binary and little endian.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace glintmark {

/// `normals` and `uvs` have the length of `positions`, or none.
struct PlyMesh {
  std::vector<glm::vec3> positions{}, normals{};
  std::vector<glm::vec2> uvs{};
  std::vector<glm::uvec3> triangles{};
};

/// Throws Error naming the file if it cannot be written.
void writePly(const PlyMesh& mesh, const std::filesystem::path& path);

}  // namespace glintmark
