// The primitives of glTF meshes as triangles of a mesh.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "host/scene/import/gltf_accessor.h"
#include "host/scene/import/gltf_materials.h"
#include "host/scene/import/gltf_skin.h"
#include "host/scene/import/mesh_source.h"

namespace glintmark {

class GltfPrimitives {
 public:
  /// Both must live as long.
  GltfPrimitives(GltfDocument& document, MeshSource& out) : document_(document), out_(out) {}

  /// The file's materials, whose parts `out` already has.
  void useMaterials(const GltfDocument::Json& materials);
  /// Appends the triangles of a primitive; points and lines are left out. `weights` are those of
  /// its morph targets, null for none. Where it hangs on joints, those of `joints` (GltfSkins,
  /// empty for none) move it, not `transform`. Throws Error.
  void add(const GltfDocument::Json& primitive, const glm::dmat4& transform,
           const std::vector<glm::dmat4>& joints, const GltfDocument::Json* weights);

 private:
  using Json = GltfDocument::Json;

  std::uint32_t partOf(const Json& primitive, GltfUv& uv);
  void requireMemoryForAll(std::size_t count);
  void addVertices(const Json& attributes, const GltfUv& uv);
  void morph(const Json& primitive, const Json& weights);
  void place(const glm::dmat4& transform);
  void place(const GltfSkinning& skinning);
  void placeVertex(std::size_t i, const glm::dmat4& transform, const glm::dmat3& for_normals);
  void addTriangles(const Json& primitive, std::uint32_t part);
  void flatten(std::size_t first_triangle);

  GltfDocument& document_;
  MeshSource& out_;
  std::vector<GltfUv> uv_of_material_;
  std::unordered_map<std::string, std::uint32_t> numbers_;  // of materials, by what names them
  // Of the primitive at hand, before its transform.
  std::vector<glm::dvec3> positions_;
  std::vector<glm::dvec3> normals_;
  std::vector<bool> mirrored_;  // by its transform; one for all, or one per vertex
  std::size_t first_vertex_ = 0;
  bool compressed_ = false;
  std::size_t unasked_bytes_ = 0;
};

}  // namespace glintmark
