#include "host/scene/import/smooth_normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/scene/import/mesh_source.h"
#include "host/scene/import/vertex_table.h"

namespace glintmark {
namespace {

class NormalMaker {
 public:
  explicit NormalMaker(MeshSource& source) : source_(source) {}

  /// The number of vertices that have no triangle with area round them.
  std::size_t run() {
    findPlaces();
    std::vector<glm::dvec3> sums(source_.positions.size(), glm::dvec3(0));
    for (const glm::uvec3& t : source_.triangles) addTriangle(t, sums);
    std::size_t left = 0;
    for (std::size_t v = 0; v < places_.size(); ++v) {
      if (places_[v] == kNoIndex) continue;
      const double length = glm::length(sums[places_[v]]);
      left += length == 0;
      source_.normals[v] = length > 0 ? sums[places_[v]] / length : glm::dvec3(0, 1, 0);
    }
    return left;
  }

 private:
  void findPlaces() {
    const std::size_t count = source_.positions.size();
    const bool grouped = !source_.smoothing.empty();
    places_.assign(count, kNoIndex);
    VertexTable table(count);
    const auto hash = [&](std::uint32_t v) {
      std::uint64_t value = grouped ? source_.smoothing[v] : 0;
      // + 0.0: the two zeros are one place.
      for (int i = 0; i < 3; ++i)
        value = mixedHash(value, std::bit_cast<std::uint64_t>(source_.positions[v][i] + 0.0));
      return value;
    };
    const auto equal = [&](std::uint32_t a, std::uint32_t b) {
      return source_.positions[a] == source_.positions[b] &&
             (!grouped || source_.smoothing[a] == source_.smoothing[b]);
    };
    for (std::uint32_t v = 0; v < count; ++v)
      if (source_.normals[v] == glm::vec3(0)) places_[v] = table.findOrAdd(v, hash, equal);
  }

  void addTriangle(const glm::uvec3& t, std::vector<glm::dvec3>& sums) const {
    if (places_[t.x] == kNoIndex && places_[t.y] == kNoIndex && places_[t.z] == kNoIndex) return;
    const glm::dvec3 corners[3] = {source_.positions[t.x], source_.positions[t.y],
                                   source_.positions[t.z]};
    glm::dvec3 edges[3];
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      edges[k] = corners[(k + 1) % 3] - corners[k];
      longest = std::max(longest, glm::length(edges[k]));
    }
    if (!(longest > 0)) return;
    for (glm::dvec3& edge : edges) edge /= longest;
    const glm::dvec3 area = glm::cross(edges[0], -edges[2]);
    const double length = glm::length(area);
    if (!(length > 0)) return;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t place = places_[t[k]];
      if (place == kNoIndex) continue;
      const glm::dvec3 a = edges[k], b = -edges[(k + 2) % 3];
      const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
      sums[place] += area * (angle / length);
    }
  }

  MeshSource& source_;
  std::vector<std::uint32_t> places_;  // per vertex without a normal, the first of its place
};

}  // namespace

void smoothNormals(MeshSource& source, const std::string& name) {
  std::size_t missing = 0, broken = 0;
  for (glm::vec3& normal : source.normals) {
    const glm::dvec3 exact = normal;
    const double length = glm::length(exact);
    const bool right = std::isfinite(length) && length > 1e-30;
    broken += !std::isfinite(length);
    missing += !right;
    normal = right ? exact / length : glm::dvec3(0);
  }
  if (broken > 0)
    source.notes.push_back(fmt::format(
        "{} normals of {} are not finite and were made from its triangles", broken, name));
  if (missing == 0) return;
  const std::size_t left = NormalMaker(source).run();
  if (left > 0)
    source.notes.push_back(fmt::format("{} normals of length 0 in {} now point up", left, name));
}

}  // namespace glintmark
