#include "host/scene/import/read_other.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include <fmt/format.h>

#include <cmath>

#include "host/core/atomic_file.h"
#include "host/core/error.h"

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

class OtherReader {
 public:
  explicit OtherReader(const std::filesystem::path& file) : source_(file.string()) {
    { const InputFile is_regular(file); }
    importer_.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                 aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    if (importer_.ReadFile(source_, 0) == nullptr) failToRead();
    for (unsigned m = 0; m < importer_.GetScene()->mNumMeshes; ++m)
      checkFaces(*importer_.GetScene()->mMeshes[m], source_);
    scene_ = importer_.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  }

  MeshSource run() {
    // Without a triangle among its points and lines, nothing is left of the file.
    if (scene_ != nullptr && scene_->mRootNode != nullptr)
      addNode(*scene_->mRootNode, aiMatrix4x4());
    return std::move(out_);
  }

 private:
  [[noreturn]] void failToRead() const {
    std::string reason = importer_.GetErrorString();
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) reason.pop_back();
    std::ranges::replace(reason, '\n', ' ');
    throw Error(fmt::format("{}: cannot be read as a mesh: {}", source_, reason));
  }

  void addNode(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      addInstance(*scene_->mMeshes[node.mMeshes[i]], transform);
    for (unsigned i = 0; i < node.mNumChildren; ++i) addNode(*node.mChildren[i], transform);
  }

  void addInstance(const aiMesh& mesh, const aiMatrix4x4& transform) {
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;
    const auto base = static_cast<std::uint32_t>(out_.positions.size());
    const aiMatrix3x3 linear(transform);
    const bool singular = linear.Determinant() == 0;
    const aiMatrix3x3 for_normals = singular ? linear : aiMatrix3x3(linear).Inverse().Transpose();
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      out_.positions.push_back(toVec3(transform * mesh.mVertices[v]));
      const bool has_normal = mesh.HasNormals() && !singular;
      out_.normals.push_back(has_normal ? toVec3(for_normals * mesh.mNormals[v]) : glm::dvec3(0));
      // Assimp's v runs up in every format.
      out_.uvs.push_back(mesh.HasTextureCoords(0) ? glm::dvec2(mesh.mTextureCoords[0][v].x,
                                                               1 - mesh.mTextureCoords[0][v].y)
                                                  : kNoUv);
    }
    const bool mirrored = transform.Determinant() < 0;
    const std::uint32_t part =
        out_.part(scene_->mMaterials[mesh.mMaterialIndex]->GetName().C_Str());
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // sorting by type leaves points in some meshes
      glm::uvec3 triangle(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
      if (mirrored) std::swap(triangle.y, triangle.z);
      out_.triangles.push_back(triangle + base);
      out_.triangle_parts.push_back(part);
    }
  }

  std::string source_;
  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  MeshSource out_;
};

}  // namespace

MeshSource readOther(const std::filesystem::path& file) {
  return OtherReader(file).run();
}

}  // namespace glintmark
