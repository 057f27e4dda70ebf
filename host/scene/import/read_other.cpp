#include "host/scene/import/read_other.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <utility>

#include "host/core/atomic_file.h"
#include "host/core/child_process.h"
#include "host/core/error.h"
#include "host/core/free_memory.h"

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

/// What assimp opens beside the file that it was given is an input too.
class InputSystem : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (Exists(file)) const InputFile input(file);
    return DefaultIOSystem::Open(file, mode);
  }
};

class OtherReader {
 public:
  explicit OtherReader(const std::filesystem::path& file) : source_(file.string()) {
    { const InputFile is_regular(file); }
    importer_.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                 aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer_.SetIOHandler(new InputSystem);  // which is its own then
    if (importer_.ReadFile(source_, 0) == nullptr) failToRead();
    requireFaces();
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
  /// Of what it does not know all of, assimp may make a scene of nothing.
  void requireFaces() const {
    const aiScene& scene = *importer_.GetScene();
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
      if (scene.mMeshes[m]->mNumFaces > 0) return;
    refuseOtherFormats();
    throw Error(
        fmt::format("{}: assimp, which reads such files, finds no triangles in it; save it as OBJ, "
                    "PLY, STL or glTF",
                    source_));
  }

  /// Assimp guesses by their first bytes what files of other names are.
  void refuseOtherFormats() const {
    const std::string extension = std::filesystem::path(source_).extension().string();
    if (!importer_.IsExtensionSupported(extension))
      throw Error(
          fmt::format("{}: cannot be read as a mesh: {} no mesh format that is read; save "
                      "it as OBJ, PLY, STL or glTF",
                      source_,
                      extension.empty() ? "without an extension it is of"
                                        : "files that end in '" + extension + "' are of"));
  }

  [[noreturn]] void failToRead() const {
    refuseOtherFormats();
    std::string reason = importer_.GetErrorString();
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) reason.pop_back();
    std::ranges::replace(reason, '\n', ' ');
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
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

// What assimp may take before it counts as stuck.
constexpr double kLeast_s = 10, kPerByte_s = 1e-5, kWallOverCpu = 10;

std::uint64_t sizeOf(const std::filesystem::path& file) {
  return InputFile(file).sizeBytes();
}

void send(int out, const void* bytes, std::size_t count) {
  writeAll(out, {static_cast<const char*>(bytes), count}, "a pipe");
}

template <typename T>
void sendAll(int out, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  send(out, &count, sizeof count);
  send(out, values.data(), count * sizeof(T));
}

void sendText(int out, const std::string& text) {
  sendAll(out, std::vector<char>(text.begin(), text.end()));
}

/// Reads the file and writes into a pipe what receive() takes: a byte for its kind, then the mesh
/// or the message of an Error.
void hand(const std::filesystem::path& file, int out) {
  constexpr char kMesh = 'M', kFault = 'F';
  try {
    const MeshSource mesh = OtherReader(file).run();
    send(out, &kMesh, 1);
    sendAll(out, mesh.positions);
    sendAll(out, mesh.normals);
    sendAll(out, mesh.uvs);
    sendAll(out, mesh.triangles);
    sendAll(out, mesh.triangle_parts);
    const std::uint64_t parts = mesh.parts.size();
    send(out, &parts, sizeof parts);
    for (const std::string& part : mesh.parts) sendText(out, part);
  } catch (const std::bad_alloc&) {
    send(out, &kFault, 1);
    sendText(out, file.string() +
                      ": asks for more memory to be read than is free; it is damaged, or too large "
                      "for this machine");
  } catch (const std::exception& fault) {
    send(out, &kFault, 1);
    sendText(out, fault.what());
  }
}

template <typename T>
bool receiveAll(ChildProcess& child, std::vector<T>& values, const std::string& source) {
  std::uint64_t count = 0;
  if (child.read(&count, sizeof count) != sizeof count) return false;
  requireMemory(count * sizeof(T), source);
  values.resize(count);
  return child.read(values.data(), count * sizeof(T)) == count * sizeof(T);
}

bool receiveText(ChildProcess& child, std::string& text, const std::string& source) {
  std::vector<char> letters;
  if (!receiveAll(child, letters, source)) return false;
  text.assign(letters.begin(), letters.end());
  return true;
}

/// False if the child ended before all was there. Throws its Error.
bool receive(ChildProcess& child, MeshSource& mesh, const std::string& source) {
  char kind = 0;
  if (child.read(&kind, 1) != 1) return false;
  if (kind == 'F') {
    std::string message;
    if (!receiveText(child, message, source)) return false;
    throw Error(message);
  }
  std::uint64_t parts = 0;
  if (!receiveAll(child, mesh.positions, source) || !receiveAll(child, mesh.normals, source) ||
      !receiveAll(child, mesh.uvs, source) || !receiveAll(child, mesh.triangles, source) ||
      !receiveAll(child, mesh.triangle_parts, source) ||
      child.read(&parts, sizeof parts) != sizeof parts)
    return false;
  for (std::uint64_t i = 0; i < parts; ++i)
    if (!receiveText(child, mesh.parts.emplace_back(), source)) return false;
  return true;
}

}  // namespace

MeshSource readOther(const std::filesystem::path& file) {
  return readOther(file, {.cpu_s = kLeast_s + static_cast<double>(sizeOf(file)) * kPerByte_s});
}

MeshSource readOther(const std::filesystem::path& file, const ImportLimits& limits) {
  const std::string source = file.string();
  ChildProcess child([&](int out) { hand(file, out); }, {.cpu_s = limits.cpu_s,
                                                         .wall_s = kWallOverCpu * limits.cpu_s,
                                                         .memory_bytes = freeMemoryBytes()});
  MeshSource mesh;
  const bool whole = receive(child, mesh, source);
  const std::string end = child.finish();
  if (whole && end.empty()) return mesh;
  throw Error(
      fmt::format("{}: cannot be read as a mesh: assimp, which reads such files, {}; save "
                  "it as OBJ, PLY, STL or glTF",
                  source, end.empty() ? "ended early" : end));
}

}  // namespace glintmark
