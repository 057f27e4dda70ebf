#include "host/scene/import/gltf_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace glintmark {
namespace {

using Json = GltfDocument::Json;

constexpr int kMatrixNumbers = 16;

std::string jointsName(std::size_t set) {
  return fmt::format("JOINTS_{}", set);
}

std::string weightsName(std::size_t set) {
  return fmt::format("WEIGHTS_{}", set);
}

}  // namespace

glm::dmat4 gltfTransform(const GltfDocument& document, const Json& node) {
  if (node.contains("matrix")) {
    double m[kMatrixNumbers];
    document.numbers(node, "matrix", kMatrixNumbers, m);
    glm::dmat4 matrix;
    for (int i = 0; i < kMatrixNumbers; ++i) matrix[i / 4][i % 4] = m[i];
    return matrix;
  }
  double t[3] = {0, 0, 0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
  document.numbers(node, "translation", 3, t);
  document.numbers(node, "rotation", 4, r);
  document.numbers(node, "scale", 3, s);
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  glm::dmat4 matrix(1);
  if (length > 0 && std::isfinite(length))
    matrix = glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
  for (int c = 0; c < 3; ++c) matrix[c] *= s[c];
  matrix[3] = glm::dvec4(t[0], t[1], t[2], 1);
  return matrix;
}

std::vector<glm::dmat4> GltfSkins::joints(const Json& skin) {
  const Json& description = document_.object("skins", skin);
  const auto nodes = description.find("joints");
  if (nodes == description.end() || !nodes->is_array() || nodes->empty())
    document_.fail(fmt::format("skin {} has no joints", skin.dump()));
  std::vector<glm::dmat4> matrices;
  matrices.reserve(nodes->size());
  for (const Json& node : *nodes) matrices.push_back(placeOf(node));
  const auto bound = description.find("inverseBindMatrices");
  if (bound == description.end()) return matrices;
  const GltfAccessor inverse(document_, *bound);
  if (inverse.count() < matrices.size() || inverse.components() != kMatrixNumbers)
    document_.fail(fmt::format("skin {} has {} joints, but {} inverse bind matrices of {} numbers",
                               skin.dump(), matrices.size(), inverse.count(),
                               inverse.components()));
  for (std::size_t j = 0; j < matrices.size(); ++j) {
    glm::dmat4 matrix;
    for (int i = 0; i < kMatrixNumbers; ++i) matrix[i / 4][i % 4] = inverse.at(j, i);
    matrices[j] *= matrix;
  }
  return matrices;
}

void GltfSkins::findParents() {
  const Json& nodes = document_.root()["nodes"];
  for (std::size_t i = 0; i < nodes.size(); ++i) parents_.push_back(i);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].is_object() || !nodes[i].contains("children")) continue;
    for (const Json& child : nodes[i]["children"])
      if (child.is_number_unsigned() && child.get<std::size_t>() < parents_.size())
        parents_[child.get<std::size_t>()] = i;
  }
}

glm::dmat4 GltfSkins::placeOf(const Json& node) {
  document_.object("nodes", node);
  if (parents_.empty()) findParents();
  // Up to a node whose place is known, or that has no parent; then down again.
  std::vector<std::size_t> open;
  glm::dmat4 place(1);
  for (auto at = node.get<std::size_t>();; at = parents_[at]) {
    if (const auto known = places_.find(at); known != places_.end()) {
      place = known->second;
      break;
    }
    open.push_back(at);
    if (open.size() > parents_.size())
      document_.fail(fmt::format("joint {} is its own ancestor, expected a tree", node.dump()));
    if (parents_[at] == at) break;
  }
  for (std::size_t i = open.size(); i-- > 0;) {
    place = place * gltfTransform(document_, document_.object("nodes", open[i]));
    places_.emplace(open[i], place);
  }
  return place;
}

bool GltfSkinning::isIn(const Json& attributes) {
  return attributes.contains(jointsName(0)) && attributes.contains(weightsName(0));
}

GltfSkinning::GltfSkinning(GltfDocument& document, const Json& attributes,
                           const std::vector<glm::dmat4>& joints, std::size_t count)
    : document_(document), joints_(joints) {
  for (std::size_t set = 0;; ++set) {
    const auto of_joints = attributes.find(jointsName(set));
    const auto of_weights = attributes.find(weightsName(set));
    if (of_joints == attributes.end() || of_weights == attributes.end()) return;
    const Set& added = sets_.emplace_back(document, *of_joints, *of_weights);
    const std::size_t least = std::min(added.joints.count(), added.weights.count());
    if (least < count)
      document.fail(fmt::format("a primitive has {} positions, but {} joints and {} weights", count,
                                added.joints.count(), added.weights.count()));
  }
}

const glm::dmat4& GltfSkinning::joint(const Set& set, std::size_t vertex, int c) const {
  const double number = set.joints.at(vertex, c);
  if (!(number >= 0 && number < static_cast<double>(joints_.size())))
    document_.fail(fmt::format("vertex {} of a primitive hangs on joint {}, but its skin has {}",
                               vertex, number, joints_.size()));
  return joints_[static_cast<std::size_t>(number)];
}

glm::dmat4 GltfSkinning::matrix(std::size_t vertex) const {
  glm::dmat4 sum(0);
  double weights = 0;
  for (const Set& set : sets_)
    for (int c = 0; c < std::min(set.joints.components(), set.weights.components()); ++c) {
      const double weight = set.weights.at(vertex, c);
      if (weight == 0) continue;
      sum += weight * joint(set, vertex, c);
      weights += weight;
    }
  // Weights of whole numbers add up to nearly 1 only.
  return weights > 0 ? sum / weights : joint(sets_.front(), vertex, 0);
}

}  // namespace glintmark
