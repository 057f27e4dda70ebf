// Where the nodes of a glTF file stand, and the joints of its skins.
#pragma once
#include <deque>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "host/scene/import/gltf_accessor.h"
#include "host/scene/import/gltf_document.h"

namespace glintmark {

/// The place of a node within its parent: of its matrix, or of its translation, rotation and scale.
/// Throws Error for what is not as many numbers as it should be.
glm::dmat4 gltfTransform(const GltfDocument& document, const GltfDocument::Json& node);

/// What the joints of glTF 2.0 make of vertices in the pose that the file's nodes have, which is
/// the one at rest. [Khronos, "glTF 2.0 Specification", 3.7.3]
class GltfSkins {
 public:
  /// The document must live as long.
  explicit GltfSkins(GltfDocument& document) : document_(document) {}

  /// Matrix of each joint of a skin: where the joint stands in the scene times its inverse bind
  /// matrix. Throws Error for joints that are no nodes and for fewer matrices than joints.
  std::vector<glm::dmat4> joints(const GltfDocument::Json& skin);

 private:
  using Json = GltfDocument::Json;

  void findParents();
  glm::dmat4 placeOf(const Json& node);

  GltfDocument& document_;
  std::vector<std::size_t> parents_;          // of each node; its own number: it has none
  std::map<std::size_t, glm::dmat4> places_;  // of nodes, as far as they were asked for
};

/// How the vertices of a primitive hang on joints.
class GltfSkinning {
 public:
  /// Reads JOINTS_0, WEIGHTS_0 and those that follow. Throws Error for fewer of them than `count`
  /// vertices. The document and the joints must live as long.
  GltfSkinning(GltfDocument& document, const GltfDocument::Json& attributes,
               const std::vector<glm::dmat4>& joints, std::size_t count);

  /// Has a primitive of these attributes joints?
  static bool isIn(const GltfDocument::Json& attributes);

  /// The mean of the matrices of a vertex's joints by their weights; its first joint's where all
  /// weights are 0. Throws Error for a joint that its skin does not have.
  glm::dmat4 matrix(std::size_t vertex) const;

 private:
  struct Set {
    Set(GltfDocument& document, const GltfDocument::Json& of_joints,
        const GltfDocument::Json& of_weights)
        : joints(document, of_joints), weights(document, of_weights) {}
    GltfAccessor joints, weights;
  };

  const glm::dmat4& joint(const Set& set, std::size_t vertex, int c) const;

  const GltfDocument& document_;
  const std::vector<glm::dmat4>& joints_;
  std::deque<Set> sets_;
};

}  // namespace glintmark
