#include "host/scene/import_mesh.h"
#include "host/scene/glb_header.h"
#include "host/scene/ply_header.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include <fmt/format.h>

#include "host/core/error.h"
#include "host/scene/mesh_checks.h"

namespace glintmark {
namespace {

glm::dvec3 toVec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// A file's mesh must be sound before assimp may work on it: its later steps trust the indices.
void checkFaces(const aiMesh& mesh, const std::string& source) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    if (mesh.mFaces[f].mNumIndices == 0)
      throw Error(
          fmt::format("{}: face {} of mesh '{}' has no vertices", source, f, mesh.mName.C_Str()));
    for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k) {
      if (mesh.mFaces[f].mIndices[k] < mesh.mNumVertices) continue;
      throw Error(fmt::format("{}: face {} of mesh '{}' names vertex {}, but there are only {}",
                              source, f, mesh.mName.C_Str(), mesh.mFaces[f].mIndices[k],
                              mesh.mNumVertices));
    }
  }
}

/// Uvs along the two axes that the mesh faces most, in scene units.
void projectPlanar(TriangleMesh& mesh, std::size_t first_vertex, std::size_t first_triangle) {
  glm::dvec3 facing(0);
  for (std::size_t i = first_triangle; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::dvec3 p0 = mesh.positions[t.x];
    facing += glm::abs(
        glm::cross(glm::dvec3(mesh.positions[t.y]) - p0, glm::dvec3(mesh.positions[t.z]) - p0));
  }
  int axis = 0;
  if (facing.y > facing[axis]) axis = 1;
  if (facing.z > facing[axis]) axis = 2;
  for (std::size_t v = first_vertex; v < mesh.positions.size(); ++v) {
    mesh.uvs[v] = {mesh.positions[v][(axis + 1) % 3], mesh.positions[v][(axis + 2) % 3]};
  }
}

class Importer {
 public:
  explicit Importer(const std::filesystem::path& file) : source_(file.string()) {
    importer_.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                 aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    if (file.extension() == ".ply") checkPlySize(file);
    if (file.extension() == ".glb") checkGlbSize(file);
    if (importer_.ReadFile(source_, 0) == nullptr) failToRead();
    for (unsigned m = 0; m < importer_.GetScene()->mNumMeshes; ++m) {
      checkFaces(*importer_.GetScene()->mMeshes[m], source_);
    }
    // Joining compares positions, normals and uvs, so it leaves uv seams open.
    scene_ =
        importer_.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType |
                                      aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices);
  }

  PartMesh run() {
    // Without a triangle among its points and lines, nothing is left of the file.
    if (scene_ != nullptr && scene_->mRootNode != nullptr)
      addNode(*scene_->mRootNode, aiMatrix4x4());
    const std::size_t all = out_.mesh.triangles.size();
    if (all == 0) fail("the mesh has no triangles, expected at least one");
    if (triangles_without_uv_ == all) fail("the mesh has no uvs, expected texture coordinates");
    if (triangles_without_uv_ > 0) {
      out_.notes.push_back(fmt::format("{} of {} triangles have no uvs in {} and got planar ones",
                                       triangles_without_uv_, all,
                                       std::filesystem::path(source_).filename().string()));
    }
    checkMesh(out_.mesh, source_);
    normaliseNormals();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("{}: {}", source_, reason));
  }

  [[noreturn]] void failToRead() const {
    std::string reason = importer_.GetErrorString();
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) reason.pop_back();
    fail("cannot be read as a mesh: " + reason);
  }

  void addNode(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      addInstance(*scene_->mMeshes[node.mMeshes[i]], transform);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) addNode(*node.mChildren[i], transform);
  }

  void addInstance(const aiMesh& mesh, const aiMatrix4x4& transform) {
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;
    TriangleMesh& out = out_.mesh;
    const std::size_t first_vertex = out.positions.size(), first_triangle = out.triangles.size();
    const aiMatrix3x3 for_normals = aiMatrix3x3(transform).Inverse().Transpose();
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      out.positions.push_back(toVec3(transform * mesh.mVertices[v]));
      out.normals.push_back(mesh.HasNormals() ? toVec3(for_normals * mesh.mNormals[v])
                                              : glm::dvec3(0));
      out.uvs.push_back(mesh.HasTextureCoords(0)
                            ? glm::dvec2(mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y)
                            : glm::dvec2(0));
    }
    const bool mirrored = transform.Determinant() < 0;
    const auto base = static_cast<std::uint32_t>(first_vertex);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // sorting by type leaves points in some meshes
      glm::uvec3 triangle(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
      if (mirrored) std::swap(triangle.y, triangle.z);
      out.triangles.push_back(triangle + base);
      out.triangle_materials.push_back(partOf(mesh));
    }
    if (!mesh.HasTextureCoords(0)) {
      projectPlanar(out, first_vertex, first_triangle);
      triangles_without_uv_ += out.triangles.size() - first_triangle;
    }
  }

  std::uint32_t partOf(const aiMesh& mesh) {
    const std::string name = scene_->mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    for (std::size_t i = 0; i < out_.parts.size(); ++i) {
      if (out_.parts[i] == name) return static_cast<std::uint32_t>(i);
    }
    out_.parts.push_back(name);
    return static_cast<std::uint32_t>(out_.parts.size() - 1);
  }

  /// A vertex of triangles without area has no normal of its own.
  void normaliseNormals() {
    std::size_t repaired = 0;
    for (glm::vec3& normal : out_.mesh.normals) {
      const glm::dvec3 exact = normal;
      const double length = glm::length(exact);
      if (length < 1e-12) ++repaired;
      normal = length < 1e-12 ? glm::dvec3(0, 1, 0) : exact / length;
    }
    if (repaired > 0) {
      out_.notes.push_back(fmt::format("{} normals of length 0 now point up", repaired));
    }
  }

  std::string source_;
  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  PartMesh out_;
  std::size_t triangles_without_uv_ = 0;
};

}  // namespace

PartMesh importMesh(const std::filesystem::path& file) {
  return Importer(file).run();
}

}  // namespace glintmark
