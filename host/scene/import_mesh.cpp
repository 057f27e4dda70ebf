#include "host/scene/import_mesh.h"

#include <algorithm>
#include <cctype>

#include "host/core/atomic_file.h"
#include "host/scene/import/finish_mesh.h"
#include "host/scene/import/read_gltf.h"
#include "host/scene/import/read_obj.h"
#include "host/scene/import/read_other.h"
#include "host/scene/import/read_ply.h"
#include "host/scene/import/read_stl.h"

namespace glintmark {
namespace {

MeshSource readMeshFile(const std::filesystem::path& file, const ImportOptions& options) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string name = file.string();
  if (extension == ".obj") return readObj(readFile(file), name);
  if (extension == ".ply") return readPly(readFile(file), name);
  if (extension == ".stl") return readStl(file);
  if (extension == ".gltf" || extension == ".glb" || extension == ".vrm")
    return readGltf(file, options.wants_materials);
  return readOther(file);
}

}  // namespace

PartMesh importMesh(const std::filesystem::path& file, const ImportOptions& options) {
  return finishMesh(readMeshFile(file, options), file.string(), options);
}

}  // namespace glintmark
