#include "host/scene/mesh_frames.h"

#include <cmath>
#include <cstdint>

namespace glintmark {
namespace {

struct TriangleTangent {
  glm::dvec3 direction{0};  // along dP/du, length: twice the triangle's area
  int side = 0;             // sign of the uv area; 0: none
};

TriangleTangent tangentOf(const TriangleMesh& mesh, const glm::uvec3& triangle) {
  const glm::dvec3 p0 = mesh.positions[triangle.x];
  const glm::dvec3 e1 = glm::dvec3(mesh.positions[triangle.y]) - p0;
  const glm::dvec3 e2 = glm::dvec3(mesh.positions[triangle.z]) - p0;
  const glm::dvec2 d1 = mesh.uvs[triangle.y] - mesh.uvs[triangle.x];
  const glm::dvec2 d2 = mesh.uvs[triangle.z] - mesh.uvs[triangle.x];
  const double uv_area = d1.x * d2.y - d2.x * d1.y;
  const glm::dvec3 direction = (e1 * d2.y - e2 * d1.y) * (uv_area < 0 ? -1.0 : 1.0);
  const double length = glm::length(direction);
  if (uv_area == 0 || length == 0) return {};
  return {direction * (glm::length(glm::cross(e1, e2)) / length), uv_area < 0 ? -1 : 1};
}

/// Gives every vertex used on both sides a twin for its mirrored triangles.
void splitMirroredVertices(TriangleMesh& mesh, const std::vector<std::int8_t>& sides) {
  constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  std::vector<std::uint8_t> used_unmirrored(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] <= 0) continue;
    for (int k = 0; k < 3; ++k) used_unmirrored[mesh.triangles[i][k]] = 1;
  }
  std::vector<std::uint32_t> twin(mesh.positions.size(), kNone);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] >= 0) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[i][k];
      if (!used_unmirrored[vertex]) continue;
      if (twin[vertex] == kNone) {
        twin[vertex] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
        mesh.normals.push_back(glm::vec3(mesh.normals[vertex]));
        mesh.uvs.push_back(glm::dvec2(mesh.uvs[vertex]));
      }
      mesh.triangles[i][k] = twin[vertex];
    }
  }
}

}  // namespace

void computeTangents(TriangleMesh& mesh) {
  {
    // Tangents are worked out twice rather than kept: meshes may have tens of millions.
    std::vector<std::int8_t> triangle_sides;
    triangle_sides.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles)
      triangle_sides.push_back(static_cast<std::int8_t>(tangentOf(mesh, triangle).side));
    splitMirroredVertices(mesh, triangle_sides);
  }

  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  std::vector<std::int8_t> sides(mesh.positions.size(), 1);
  for (const glm::uvec3& triangle : mesh.triangles) {
    const TriangleTangent tangent = tangentOf(mesh, triangle);
    if (tangent.side == 0) continue;
    for (int k = 0; k < 3; ++k) {
      sums[triangle[k]] += tangent.direction;
      sides[triangle[k]] = static_cast<std::int8_t>(tangent.side);
    }
  }
  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const glm::dvec3 normal = mesh.normals[v];
    glm::dvec3 tangent = sums[v] - normal * glm::dot(normal, sums[v]);
    if (glm::length(tangent) <= 1e-6 * glm::length(sums[v])) {
      const glm::dvec3 other = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
      tangent = glm::cross(other, normal);
    }
    mesh.tangents[v] = glm::vec4(glm::normalize(tangent), sides[v]);
  }
}

}  // namespace glintmark
