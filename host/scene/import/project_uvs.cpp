#include "host/scene/import/project_uvs.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "host/scene/import/mesh_source.h"

namespace glintmark {
namespace {

// uv units that the longest side of a mesh spans where its uvs have no area: a thousandth of it
// holds so many microdetails of any density that they cannot be told from their mean.
constexpr double kDenseSpan_uv = 1 << 20;

enum class Kind : std::uint8_t { kOwnUvs, kNoUvs, kNoUvArea };

int longestAxis(const glm::dvec3& v) {
  int axis = 0;
  if (v.y > v[axis]) axis = 1;
  if (v.z > v[axis]) axis = 2;
  return axis;
}

class UvProjector {
 public:
  explicit UvProjector(MeshSource& source) : source_(source), kinds_(source.triangles.size()) {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      kinds_[i] = kindOf(source.triangles[i]);
      ++counts_[static_cast<int>(kinds_[i])];
    }
  }

  std::size_t count(Kind kind) const { return counts_[static_cast<int>(kind)]; }

  void project(bool box, double scale) {
    findPartAxes();
    ways_.assign(source_.positions.size(), kUntouched);
    for (std::size_t i = 0; i < kinds_.size(); ++i)
      for (int k = 0; k < 3 && kinds_[i] == Kind::kOwnUvs; ++k)
        ways_[source_.triangles[i][k]] = kOwn;
    const double dense = kDenseSpan_uv / std::max(longestSide(), 1e-300);
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i] == Kind::kOwnUvs) continue;
      const bool no_uvs = kinds_[i] == Kind::kNoUvs;
      const int axis = no_uvs && box ? longestAxis(facing(source_.triangles[i]))
                                     : part_axis_[source_.triangle_parts[i]];
      // One vertex may get uvs along each axis, and of either scale.
      for (int k = 0; k < 3; ++k)
        place(source_.triangles[i][k], axis, no_uvs ? scale : dense, no_uvs ? axis : 3 + axis);
    }
  }

  double longestSide() const {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::uvec3& t : source_.triangles)
      for (int k = 0; k < 3; ++k) {
        low = glm::min(low, source_.positions[t[k]]);
        high = glm::max(high, source_.positions[t[k]]);
      }
    const glm::dvec3 size = high - low;
    return size[longestAxis(size)];
  }

 private:
  Kind kindOf(const glm::uvec3& t) const {
    const glm::dvec2 a = source_.uvs[t.x], b = source_.uvs[t.y], c = source_.uvs[t.z];
    if (a == kNoUv || b == kNoUv || c == kNoUv) return Kind::kNoUvs;
    const glm::dvec2 d1 = b - a, d2 = c - a;
    return d1.x * d2.y - d2.x * d1.y == 0 ? Kind::kNoUvArea : Kind::kOwnUvs;
  }

  /// Along each axis, how much of the triangle faces it; of its own unit of length.
  glm::dvec3 facing(const glm::uvec3& t) const {
    const glm::dvec3 p0 = source_.positions[t.x];
    return glm::abs(glm::cross(source_.positions[t.y] - p0, source_.positions[t.z] - p0));
  }

  void findPartAxes() {
    std::vector<glm::dvec3> sums(source_.parts.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < kinds_.size(); ++i)
      if (kinds_[i] != Kind::kOwnUvs)
        sums[source_.triangle_parts[i]] += facing(source_.triangles[i]);
    for (const glm::dvec3& sum : sums) part_axis_.push_back(longestAxis(sum));
  }

  /// Makes the vertex that a corner names one with the projection `way`.
  void place(std::uint32_t& vertex, int axis, double scale, int way) {
    std::uint32_t v = vertex;
    while (ways_[v] != kUntouched && ways_[v] != way) {
      if (next_.size() <= v) next_.resize(source_.positions.size(), kNoIndex);
      if (next_[v] == kNoIndex) {
        const auto copy = static_cast<std::uint32_t>(source_.positions.size());
        next_[v] = copy;
        source_.positions.push_back(glm::dvec3(source_.positions[v]));
        source_.normals.push_back(glm::vec3(source_.normals[v]));
        source_.uvs.push_back(kNoUv);
        if (!source_.smoothing.empty())
          source_.smoothing.push_back(std::uint32_t{source_.smoothing[v]});
        ways_.push_back(kUntouched);
        next_.push_back(kNoIndex);
      }
      v = next_[v];
    }
    vertex = v;
    if (ways_[v] == way) return;
    ways_[v] = static_cast<std::uint8_t>(way);
    const glm::dvec3& p = source_.positions[v];
    source_.uvs[v] = scale * glm::dvec2(p[(axis + 1) % 3], p[(axis + 2) % 3]);
  }

  static constexpr std::uint8_t kUntouched = 255, kOwn = 254;

  MeshSource& source_;
  std::vector<Kind> kinds_;
  std::array<std::size_t, 3> counts_{};
  std::vector<int> part_axis_;
  std::vector<std::uint8_t> ways_;   // per vertex, the projection that it has
  std::vector<std::uint32_t> next_;  // per vertex, its copy for another projection
};

}  // namespace

void projectUvs(MeshSource& source, UvProjection projection, const std::string& name) {
  UvProjector projector(source);
  const std::size_t all = source.triangles.size(), none = projector.count(Kind::kNoUvs),
                    flat = projector.count(Kind::kNoUvArea);
  if (none + flat == 0) return;
  const bool whole = none == all;
  const bool box = projection == UvProjection::kBox || (projection == UvProjection::kAuto && whole);
  const double side = whole ? projector.longestSide() : 1;
  projector.project(box, side > 0 ? 1 / side : 1);
  const char* const kind = box ? "box" : "planar";
  if (whole)
    source.notes.push_back(
        fmt::format("{} has no uvs and got {} ones; mesh.uv = \"{}\" gives others", name, kind,
                    box ? "planar" : "box"));
  if (none > 0 && !whole)
    source.notes.push_back(
        fmt::format("{} of {} triangles have no uvs in {} and got {} ones", none, all, name, kind));
  if (flat > 0)
    source.notes.push_back(fmt::format(
        "{} of {} triangles in {} have uvs without area: their microdetails and normal maps "
        "show as their mean",
        flat, all, name));
}

}  // namespace glintmark
