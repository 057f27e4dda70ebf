// Meshes of a Mitsuba scene.
#include <limits>

#include "host/export/mitsuba_parts.h"
#include "host/export/ply_file.h"

namespace glintmark {
namespace {

// The triangles of a part, vertices in the order of their first use. Maps repeat, so uvs move
// by whole periods to where floats are finest.
PlyMesh meshOf(const Scene& scene, const MaterialPart& of) {
  const TriangleMesh& mesh = scene.mesh;
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> own(mesh.positions.size(), kUnused), used;
  PlyMesh part;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!of.has(scene, t)) continue;
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

}  // namespace

bool MaterialPart::has(const Scene& scene, std::size_t triangle) const {
  const TriangleMesh& mesh = scene.mesh;
  if (mesh.triangle_materials[triangle] != material) return false;
  const bool is_mirrored = mesh.tangents[mesh.triangles[triangle].x].w < 0;
  return !scene.materials[material].normal_map || is_mirrored == mirrored;
}

std::vector<MaterialPart> materialParts(const Scene& scene) {
  std::vector<MaterialPart> parts;
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
    for (const bool mirrored : {false, true}) {
      if (mirrored && !scene.materials[i].normal_map) continue;
      const MaterialPart part{i, mirrored};
      for (std::size_t t = 0; t < scene.mesh.triangleCount(); ++t)
        if (part.has(scene, t)) {
          parts.push_back(part);
          break;
        }
    }
  return parts;
}

void writeMeshes(MitsubaScene& to) {
  for (const MaterialPart& part : materialParts(to.scene)) {
    const std::string file = fmt::format("mesh_{}.ply", part.name());
    writePly(meshOf(to.scene, part), to.folder / file);
    to.xml.open("shape", {{"type", "ply"}});
    to.xml.leaf("string", {{"name", "filename"}, {"value", file}});
    to.xml.leaf("ref", {{"id", "material_" + part.name()}});
    to.xml.close();
  }
  to.notes.emplace_back("meshes throw shadows, here they throw none");
  if (to.scene.cull_back_faces)
    to.notes.emplace_back("faces are seen from both sides, here from the front alone");
}

}  // namespace glintmark
