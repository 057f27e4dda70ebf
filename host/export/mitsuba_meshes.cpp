// Meshes of a Mitsuba scene.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/export/mitsuba_parts.h"
#include "host/export/ply_file.h"

namespace glintmark {
namespace {

// The triangles of one material, vertices in the order of their first use. Maps repeat, so uvs move
// by whole periods to where floats are finest.
PlyMesh meshOf(const TriangleMesh& mesh, std::uint32_t material) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> own(mesh.positions.size(), kUnused), used;
  PlyMesh part;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (mesh.triangle_materials[t] != material) continue;
    glm::uvec3 triangle = mesh.triangles[t];
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& index = own[triangle[k]];
      if (index == kUnused) {
        index = static_cast<std::uint32_t>(used.size());
        used.push_back(triangle[k]);
      }
      triangle[k] = index;
    }
    part.triangles.push_back(triangle);
  }
  glm::dvec2 low(std::numeric_limits<double>::max());
  for (const std::uint32_t i : used) low = glm::min(low, mesh.uvs[i]);
  for (const std::uint32_t i : used) {
    part.positions.push_back(mesh.positions[i]);
    part.normals.push_back(mesh.normals[i]);
    part.uvs.push_back(glm::vec2(mesh.uvs[i] - glm::floor(low)));
  }
  return part;
}

bool hasMirroredCharts(const TriangleMesh& mesh) {
  return std::ranges::any_of(mesh.tangents, [](const glm::vec4& tangent) { return tangent.w < 0; });
}

}  // namespace

void writeMeshes(MitsubaScene& to) {
  for (std::size_t i = 0; i < to.scene.materials.size(); ++i) {
    const PlyMesh mesh = meshOf(to.scene.mesh, static_cast<std::uint32_t>(i));
    if (mesh.triangles.empty()) continue;
    const std::string name = fmt::format("mesh_{}.ply", i);
    writePly(mesh, to.folder / name);
    to.xml.open("shape", {{"type", "ply"}});
    to.xml.leaf("string", {{"name", "filename"}, {"value", name}});
    to.xml.leaf("ref", {{"id", fmt::format("material_{}", i)}});
    to.xml.close();
  }
  to.notes.emplace_back("meshes throw shadows, here they throw none");
  if (to.scene.cull_back_faces)
    to.notes.emplace_back("faces are seen from both sides, here from the front alone");
  const bool mapped = std::ranges::any_of(
      to.scene.materials, [](const Material& material) { return material.normal_map.has_value(); });
  if (mapped && hasMirroredCharts(to.scene.mesh))
    to.notes.emplace_back("on mirrored uv charts normal maps are turned over");
}

}  // namespace glintmark
