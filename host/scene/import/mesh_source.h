// A mesh as a file holds it, before it is made fit to be drawn.
#pragma once
#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include "host/scene/part_mesh.h"

namespace glintmark {

/// Stands for the uv of a vertex that has none.
inline constexpr glm::dvec2 kNoUv{std::numeric_limits<double>::max()};
/// Stands for the index of what there is none of.
inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFu;

/// Arrays per vertex have one length. Positions are doubles, since files place meshes far from the
/// origin. uvs lie as maps do: row 0 of a picture at v = 0.
struct MeshSource {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  // any length; 0: to be made from the triangles round the vertex
  std::vector<glm::dvec2> uvs;
  std::vector<std::uint32_t> smoothing;  // empty, or per vertex: normals are made within a group
  std::vector<glm::uvec3> triangles;     // counter-clockwise from the front
  std::vector<std::uint32_t> triangle_parts;
  std::vector<std::string> parts;
  std::vector<std::string> notes;
  std::vector<FileMaterial> materials;  // empty, or one per part

  std::unordered_map<std::string, std::uint32_t> part_numbers;  // of those that part() made

  /// Index of the part of that name, new or known. Readers that call it add no part otherwise.
  std::uint32_t part(const std::string& name) {
    const auto [found, is_new] =
        part_numbers.emplace(name, static_cast<std::uint32_t>(parts.size()));
    if (is_new) parts.push_back(name);
    return found->second;
  }
};

/// Makes room for `count` more elements; room at least doubles, so that many calls stay linear.
template <typename T>
void reserveMore(std::vector<T>& values, std::size_t count) {
  const std::size_t needed = values.size() + count;
  if (needed > values.capacity()) values.reserve(std::max(needed, 2 * values.capacity()));
}

}  // namespace glintmark
