#include "host/scene/import/read_gltf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "host/core/error.h"
#include "host/scene/import/gltf_accessor.h"
#include "host/scene/import/gltf_document.h"
#include "host/scene/import/gltf_materials.h"
#include "host/scene/import/gltf_primitive.h"
#include "host/scene/import/gltf_skin.h"

namespace glintmark {
namespace {

using Json = GltfDocument::Json;

constexpr std::size_t kMostNodes = 10'000'000;

/// What moves the meshes of a node.
struct Placement {
  glm::dmat4 transform{1};
  std::vector<glm::dmat4> joints{};  // empty for none
};

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& file, bool wants_materials)
      : document_(file),
        wants_materials_(wants_materials),
        primitives_(document_, out_),
        skins_(document_) {}

  MeshSource run() {
    readMaterials();
    const std::vector<Json> roots = rootNodes();
    for (const Json& root : roots) walk(root);
    if (roots.empty()) addAllMeshes();
    addNotes();
    return std::move(out_);
  }

 private:
  void readMaterials() {
    const auto all = document_.root().find("materials");
    if (all == document_.root().end()) return;
    for (const auto& [key, material] : all->items()) {
      if (!material.is_object()) document_.fail(fmt::format("material {} is no object", key));
      const bool named = material.contains("name");
      out_.parts.push_back(named                      ? document_.text(material, "name")
                           : document_.version() == 1 ? key
                                                      : "");
      if (document_.version() == 1 || !wants_materials_) continue;
      out_.materials.push_back(gltfMaterial(document_, material));
    }
    primitives_.useMaterials(*all);
    materials_ = all->size();
  }

  std::vector<Json> rootNodes() const {
    const Json& root = document_.root();
    const auto scenes = root.find("scenes");
    if (scenes != root.end() && !scenes->empty()) {
      const auto chosen = root.find("scene");
      const Json& scene =
          chosen != root.end() ? document_.object("scenes", *chosen) : *scenes->begin();
      if (scene.is_object() && scene.contains("nodes") && scene["nodes"].is_array())
        return scene["nodes"].get<std::vector<Json>>();
    }
    // Without a scene: the nodes that are no node's child.
    std::vector<Json> roots;
    const auto nodes = root.find("nodes");
    if (nodes == root.end()) return roots;
    std::set<std::string> children;
    for (const Json& node : *nodes)
      if (node.is_object() && node.contains("children"))
        for (const Json& child : node["children"]) children.insert(child.dump());
    for (const auto& [key, node] : nodes->items()) {
      const Json reference = nodes->is_array() ? Json(std::stoull(key)) : Json(key);
      if (!children.contains(reference.dump())) roots.push_back(reference);
    }
    return roots;
  }

  void walk(const Json& root) {
    std::vector<std::pair<Json, glm::dmat4>> open = {{root, glm::dmat4(1)}};
    while (!open.empty()) {
      const auto [reference, parent] = std::move(open.back());
      open.pop_back();
      const Json& node = document_.object("nodes", reference);
      if (!visited_.insert(reference.dump()).second || visited_.size() > kMostNodes)
        document_.fail(fmt::format(
            "node {} has two parents or is its own ancestor, expected a tree", reference.dump()));
      const glm::dmat4 transform = parent * gltfTransform(document_, node);
      addMeshes(node, transform);
      const auto children = node.find("children");
      if (children == node.end()) continue;
      // The last is taken first, so that they come in the file's order.
      for (auto child = children->rbegin(); child != children->rend(); ++child)
        open.emplace_back(*child, transform);
    }
  }

  void addMeshes(const Json& node, const glm::dmat4& transform) {
    const Placement place = placementOf(node, transform);
    const Json* weights = node.contains("weights") ? &node["weights"] : nullptr;
    if (const Json* instances = GltfDocument::extension(node, "EXT_mesh_gpu_instancing");
        instances != nullptr && node.contains("mesh"))
      ++instanced_;
    if (const auto mesh = node.find("mesh"); mesh != node.end()) addMesh(*mesh, place, weights);
    if (const auto meshes = node.find("meshes"); meshes != node.end())
      for (const Json& mesh : *meshes) addMesh(mesh, place, weights);
  }

  /// Where joints move a mesh, its node does not.
  Placement placementOf(const Json& node, const glm::dmat4& transform) {
    const auto skin = node.find("skin");
    if (document_.version() == 1) {
      const bool skinned = skin != node.end() || node.contains("skeletons");
      bound_ += skinned;
      return {skinned ? glm::dmat4(1) : transform, {}};
    }
    if (skin == node.end() || !node.contains("mesh")) return {transform, {}};
    ++skinned_;
    return {transform, skins_.joints(*skin)};
  }

  void addMesh(const Json& reference, const Placement& place, const Json* weights) {
    const Json& mesh = document_.object("meshes", reference);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) return;
    if (weights == nullptr && mesh.contains("weights")) weights = &mesh["weights"];
    bool morphs = false;
    for (const Json& primitive : *primitives) {
      if (!primitive.is_object()) document_.fail("a primitive of a mesh is no object");
      morphs = morphs || primitive.contains("targets");
      primitives_.add(primitive, place.transform, place.joints, weights);
    }
    morphs_ += morphs;
  }

  void addAllMeshes() {
    const auto meshes = document_.root().find("meshes");
    if (meshes == document_.root().end()) return;
    for (const auto& [key, mesh] : meshes->items())
      addMesh(meshes->is_array() ? Json(std::stoull(key)) : Json(key), {}, nullptr);
  }

  void addNotes() {
    const auto note = [&](std::size_t count, const char* text) {
      if (count > 0)
        out_.notes.push_back(
            fmt::format("{} of {} {}", count,
                        std::filesystem::path(document_.source()).filename().string(), text));
    };
    note(morphs_, "meshes with morph targets stand at their default weights");
    note(skinned_, "skinned meshes stand in the pose that their joints have at rest");
    note(bound_, "skinned meshes stand in the pose they were bound in");
    note(instanced_, "nodes have instances by EXT_mesh_gpu_instancing, of which one each is drawn");
    if (materials_ > 0 && !wants_materials_)
      out_.notes.push_back(
          fmt::format("the {} materials of {} were not used; materials = \"file\" takes them",
                      materials_, std::filesystem::path(document_.source()).filename().string()));
  }

  GltfDocument document_;
  bool wants_materials_;
  MeshSource out_;
  GltfPrimitives primitives_;
  GltfSkins skins_;
  std::set<std::string> visited_;
  std::size_t materials_ = 0, morphs_ = 0, skinned_ = 0, bound_ = 0, instanced_ = 0;
};

}  // namespace

MeshSource readGltf(const std::filesystem::path& file, bool wants_materials) {
  try {
    return GltfReader(file, wants_materials).run();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: cannot be read as a mesh: {}", file.string(), error.what()));
  }
}

}  // namespace glintmark
