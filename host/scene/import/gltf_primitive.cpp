#include "host/scene/import/gltf_primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/core/free_memory.h"

namespace glintmark {
namespace {

using Json = GltfDocument::Json;

constexpr std::uint64_t kTriangles = 4, kStrip = 5, kFan = 6;
constexpr char kDraco[] = "KHR_draco_mesh_compression";
constexpr std::size_t kBytesPerVertex = 200, kBytesHeld = 52;  // here and in what follows; here
// Memory that a file may take before the machine is asked again whether there is more.
constexpr std::size_t kUnasked_bytes = 64 << 20;

/// Turns normals as the matrix turns planes: its cofactors, which singular matrices have too. The
/// sign keeps the side that the file gives a normal.
glm::dmat3 normalMatrix(const glm::dmat4& transform) {
  glm::dmat3 m(transform);
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(m[i / 3][i % 3]));
  if (largest > 0 && std::isfinite(largest)) m /= largest;
  const double side = glm::determinant(m) < 0 ? -1 : 1;
  return side * glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

glm::dvec3 vectorAt(const GltfAccessor& accessor, std::size_t i) {
  glm::dvec3 v(0);
  for (int c = 0; c < std::min(accessor.components(), 3); ++c) v[c] = accessor.at(i, c);
  return v;
}

const Json* attribute(const Json& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found != attributes.end() ? &*found : nullptr;
}

}  // namespace

void GltfPrimitives::useMaterials(const Json& materials) {
  for (const auto& [key, material] : materials.items()) {
    numbers_.emplace(key, static_cast<std::uint32_t>(uv_of_material_.size()));
    uv_of_material_.push_back(document_.version() == 1 ? GltfUv() : gltfUv(document_, material));
  }
}

std::uint32_t GltfPrimitives::partOf(const Json& primitive, GltfUv& uv) {
  const auto material = primitive.find("material");
  if (material == primitive.end()) {
    // One part for all that have none, after those of the file.
    if (out_.parts.size() == numbers_.size()) out_.parts.emplace_back("DefaultMaterial");
    return static_cast<std::uint32_t>(numbers_.size());
  }
  const std::string key = material->is_string() ? material->get<std::string>() : material->dump();
  const auto found = numbers_.find(key);
  if (found == numbers_.end()) document_.fail(fmt::format("there is no material {}", shown(key)));
  uv = uv_of_material_[found->second];
  return found->second;
}

void GltfPrimitives::add(const Json& primitive, const glm::dmat4& transform,
                         const std::vector<glm::dmat4>& joints, const Json* weights) {
  const std::uint64_t mode = document_.whole(primitive, "mode", kTriangles);
  const auto attributes = primitive.find("attributes");
  if (mode < kTriangles || attributes == primitive.end() || !attributes->contains("POSITION"))
    return;
  if (mode > kFan)
    document_.fail(fmt::format("a primitive has the mode {}, expected 0 to 6", mode));
  GltfUv uv;
  const std::uint32_t part = partOf(primitive, uv);
  first_vertex_ = out_.positions.size();
  const std::size_t first_triangle = out_.triangles.size();
  positions_.clear();
  normals_.clear();
  compressed_ = GltfDocument::extension(primitive, kDraco) != nullptr;
  addVertices(*attributes, uv);
  if (weights != nullptr && weights->is_array() && primitive.contains("targets"))
    morph(primitive, *weights);
  reserveMore(out_.positions, positions_.size());
  reserveMore(out_.normals, positions_.size());
  if (!joints.empty() && GltfSkinning::isIn(*attributes)) {
    place(GltfSkinning(document_, *attributes, joints, positions_.size()));
  } else {
    place(transform);
  }
  addTriangles(primitive, part);
  if (normals_.empty()) flatten(first_triangle);
}

/// Nodes that show one mesh, and primitives that share accessors, may each be too small to be asked
/// for, but a small file may hold a million of them. What follows takes memory for all.
void GltfPrimitives::requireMemoryForAll(std::size_t count) {
  unasked_bytes_ += count * kBytesPerVertex;
  if (unasked_bytes_ < kUnasked_bytes) return;
  requireMemory(unasked_bytes_ + out_.positions.size() * (kBytesPerVertex - kBytesHeld),
                document_.source());
  unasked_bytes_ = 0;
}

void GltfPrimitives::addVertices(const Json& attributes, const GltfUv& uv) {
  const GltfAccessor positions(document_, attributes["POSITION"]);
  if (compressed_ && !positions.isStored()) document_.failToDecode(kDraco);
  const std::size_t count = positions.count();
  requireMemory(count * kBytesPerVertex, document_.source());
  requireMemoryForAll(count);
  if (out_.positions.size() + count > 0xFFFFFFF0u)
    document_.fail("the mesh has more vertices than 4294967279");
  positions_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) positions_.push_back(vectorAt(positions, i));
  const auto expectCount = [&](const GltfAccessor& accessor, const char* what) {
    if (accessor.count() < count)
      document_.fail(
          fmt::format("a primitive has {} positions, but {} {}", count, accessor.count(), what));
  };
  if (const Json* reference = attribute(attributes, "NORMAL")) {
    const GltfAccessor normals(document_, *reference);
    expectCount(normals, "normals");
    normals_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) normals_.push_back(vectorAt(normals, i));
  }
  const Json* reference = attribute(attributes, fmt::format("TEXCOORD_{}", uv.set));
  if (reference == nullptr) reference = attribute(attributes, "TEXCOORD_0");
  if (reference == nullptr && document_.version() == 1)
    reference = attribute(attributes, "TEXCOORD");
  if (reference == nullptr) {
    out_.uvs.resize(out_.uvs.size() + count, kNoUv);
    return;
  }
  const GltfAccessor uvs(document_, *reference);
  expectCount(uvs, "uvs");
  if (uvs.components() < 2)
    document_.fail(
        fmt::format("accessor {} holds uvs of one component, expected two", reference->dump()));
  reserveMore(out_.uvs, count);
  for (std::size_t i = 0; i < count; ++i)
    out_.uvs.push_back(uv.matrix * glm::dvec2(uvs.at(i, 0), uvs.at(i, 1)) + uv.offset);
}

void GltfPrimitives::morph(const Json& primitive, const Json& weights) {
  const Json& targets = primitive["targets"];
  if (!targets.is_array()) document_.fail("the morph targets of a primitive are no list");
  for (std::size_t t = 0; t < targets.size() && t < weights.size(); ++t) {
    const double weight = weights[t].is_number() ? weights[t].get<double>() : 0;
    if (weight == 0 || !targets[t].is_object()) continue;
    const auto move = [&](const char* name, std::vector<glm::dvec3>& values) {
      const Json* reference = attribute(targets[t], name);
      if (reference == nullptr || values.empty()) return;
      const GltfAccessor moves(document_, *reference);
      if (moves.count() < values.size())
        document_.fail(fmt::format("morph target {} has fewer elements than its mesh", t));
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight * vectorAt(moves, i);
    };
    move("POSITION", positions_);
    move("NORMAL", normals_);
  }
}

void GltfPrimitives::placeVertex(std::size_t i, const glm::dmat4& transform,
                                 const glm::dmat3& for_normals) {
  out_.positions.emplace_back(transform * glm::dvec4(positions_[i], 1));
  const glm::dvec3 n = normals_.empty() ? glm::dvec3(0) : for_normals * normals_[i];
  const double length = glm::length(n);
  out_.normals.emplace_back(length > 0 ? n / length : n);
}

void GltfPrimitives::place(const glm::dmat4& transform) {
  mirrored_.assign(1, glm::determinant(glm::dmat3(transform)) < 0);
  const glm::dmat3 for_normals = normalMatrix(transform);
  for (std::size_t i = 0; i < positions_.size(); ++i) placeVertex(i, transform, for_normals);
}

void GltfPrimitives::place(const GltfSkinning& skinning) {
  mirrored_.clear();
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const glm::dmat4 matrix = skinning.matrix(i);
    mirrored_.push_back(glm::determinant(glm::dmat3(matrix)) < 0);
    placeVertex(i, matrix, normalMatrix(matrix));
  }
}

void GltfPrimitives::addTriangles(const Json& primitive, std::uint32_t part) {
  const std::uint64_t mode = document_.whole(primitive, "mode", kTriangles);
  std::optional<GltfAccessor> indices;
  if (const auto reference = primitive.find("indices"); reference != primitive.end())
    indices.emplace(document_, *reference);
  const std::size_t vertices = positions_.size(), count = indices ? indices->count() : vertices;
  const auto vertex = [&](std::size_t i) {
    const std::uint32_t index = indices ? indices->index(i) : static_cast<std::uint32_t>(i);
    if (index >= vertices)
      document_.fail(fmt::format("index {} of a primitive names vertex {}, but there are only {}",
                                 i, index, vertices));
    return static_cast<std::uint32_t>(first_vertex_ + index);
  };
  const std::size_t triangles = mode == kTriangles ? count / 3 : count < 3 ? 0 : count - 2;
  reserveMore(out_.triangles, triangles);
  reserveMore(out_.triangle_parts, triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    glm::uvec3 t;
    if (mode == kTriangles) {
      t = {vertex(3 * i), vertex(3 * i + 1), vertex(3 * i + 2)};
    } else if (mode == kStrip) {
      t = {vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2)};
    } else {
      t = {vertex(i + 1), vertex(i + 2), vertex(0)};
    }
    if (mirrored_[mirrored_.size() > 1 ? t.x - first_vertex_ : 0]) std::swap(t.y, t.z);
    out_.triangles.push_back(t);
    out_.triangle_parts.push_back(part);
  }
}

/// Gives every corner of the last triangles a vertex of its own with the triangle's normal.
void GltfPrimitives::flatten(std::size_t first_triangle) {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> uvs;
  std::vector<glm::vec3> normals;
  for (std::size_t i = first_triangle; i < out_.triangles.size(); ++i) {
    const glm::uvec3 t = out_.triangles[i];
    const glm::dvec3 p = out_.positions[t.x];
    const glm::dvec3 e1 = out_.positions[t.y] - p, e2 = out_.positions[t.z] - p;
    // Edges of any length: their directions are enough.
    const double size = std::max({glm::length(e1), glm::length(e2), 1e-300});
    const glm::dvec3 n = glm::cross(e1 / size, e2 / size);
    const double length = glm::length(n);
    for (int k = 0; k < 3; ++k) {
      positions.push_back(out_.positions[t[k]]);
      uvs.push_back(out_.uvs[t[k]]);
      normals.emplace_back(length > 0 ? n / length : n);
      out_.triangles[i][k] = static_cast<std::uint32_t>(first_vertex_ + positions.size() - 1);
    }
  }
  out_.positions.resize(first_vertex_);
  out_.normals.resize(first_vertex_);
  out_.uvs.resize(first_vertex_);
  out_.positions.insert(out_.positions.end(), positions.begin(), positions.end());
  out_.normals.insert(out_.normals.end(), normals.begin(), normals.end());
  out_.uvs.insert(out_.uvs.end(), uvs.begin(), uvs.end());
}

}  // namespace glintmark
