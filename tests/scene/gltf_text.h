// Small glTF files for tests: a quad of two triangles, whose numbers and JSON each test changes.
#pragma once
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/scene/import_mesh.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {

using Json = nlohmann::json;

template <typename T>
std::string rawBytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A document under construction: one buffer, one view for each accessor.
struct GltfText {
  Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},  {"nodes", {{{"mesh", 0}}}},
               {"accessors", Json::array()},    {"bufferViews", Json::array()}};
  std::string bytes;

  /// Returns the new accessor's number. `stride` 0: packed.
  template <typename T>
  int add(const char* type, int component_type, std::size_t count, const std::vector<T>& values,
          int stride = 0, bool normalised = false) {
    while (bytes.size() % 4 != 0) bytes += '\0';
    Json view = {
        {"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (stride > 0) view["byteStride"] = stride;
    bytes += rawBytes(values);
    json["bufferViews"].push_back(view);
    Json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                     {"componentType", component_type},
                     {"count", count},
                     {"type", type}};
    if (normalised) accessor["normalized"] = true;
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }

  /// Writes mesh.gltf and mesh.bin; returns the path of the former.
  std::string write(const TemporaryFolder& folder) {
    folder.write("mesh.bin", bytes);
    json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "mesh.bin"}}};
    return folder.write("mesh.gltf", json.dump());
  }

  /// A GLB container of version 2.
  std::string glb() {
    json["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = json.dump();
    while (text.size() % 4 != 0) text += ' ';
    while (bytes.size() % 4 != 0) bytes += '\0';
    const auto word = [](std::size_t value) {
      return rawBytes(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
    };
    const std::size_t length = 12 + 8 + text.size() + 8 + bytes.size();
    return "glTF" + word(2) + word(length) + word(text.size()) + "JSON" + text +
           word(bytes.size()) + std::string("BIN\0", 4) + bytes;
  }
};

/// The square [0, 1]^2 in z = 0 that faces +z, with uvs that are x and y of its corners.
inline GltfText quadText() {
  GltfText text;
  const int positions = text.add<float>("VEC3", 5126, 4, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const int normals = text.add<float>("VEC3", 5126, 4, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int uvs = text.add<float>("VEC2", 5126, 4, {0, 0, 1, 0, 1, 1, 0, 1});
  const int indices = text.add<std::uint16_t>("SCALAR", 5123, 6, {0, 1, 2, 0, 2, 3});
  text.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
          {"indices", indices}}}}}};
  return text;
}

/// The mesh that the importer makes of it.
inline PartMesh gltf(GltfText text, const ImportOptions& options = {}) {
  const TemporaryFolder folder;
  return importMesh(text.write(folder), options);
}

/// What the importer says against it.
inline std::string gltfError(GltfText text) {
  const TemporaryFolder folder;
  const std::string file = text.write(folder);
  return errorOf([&] { importMesh(file); });
}

}  // namespace glintmark
