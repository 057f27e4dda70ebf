#include "host/scene/import/finish_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/scene/import/mesh_source.h"
#include "host/scene/import/project_uvs.h"
#include "host/scene/import/smooth_normals.h"
#include "host/scene/import/vertex_table.h"

namespace glintmark {
namespace {

// A mesh this many times as far from the origin as it is long loses detail in floats.
constexpr double kFarAway = 64;
// Longest sides that need no scaling.
constexpr double kSmallestSide = 1e-3, kLargestSide = 1e6;
// What joining, tangents and rasterizing take beside the file itself.
constexpr std::size_t kBytesPerTriangle = 100;

class MeshFinisher {
 public:
  MeshFinisher(MeshSource source, const std::string& name, const ImportOptions& options)
      : source_(std::move(source)),
        name_(name),
        short_name_(std::filesystem::path(name).filename().string()),
        options_(options) {}

  PartMesh run() {
    if (source_.triangles.empty()) fail("the mesh has no triangles, expected at least one");
    requireMemory(source_.triangles.size() * kBytesPerTriangle, name_);
    checkNumbers();
    dropEmptyTriangles();
    projectUvs(source_, options_.uv, short_name_);
    joinVertices();
    smoothNormals(source_, short_name_);
    source_.smoothing = {};
    PartMesh out;
    place(out.mesh);
    out.mesh.normals = std::move(source_.normals);
    out.mesh.uvs = std::move(source_.uvs);
    out.mesh.triangles = std::move(source_.triangles);
    out.mesh.triangle_materials = std::move(source_.triangle_parts);
    out.parts = std::move(source_.parts);
    out.notes = std::move(source_.notes);
    out.materials = std::move(source_.materials);
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("{}: {}", name_, reason));
  }

  /// Of vertices that triangles name; what others hold does not matter.
  void checkNumbers() const {
    const auto finite = [](const auto& v) {
      return std::isfinite(glm::dot(v, decltype(v * 1.0)(0)));
    };
    const std::size_t count = source_.positions.size();
    for (std::size_t i = 0; i < source_.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = source_.triangles[i][k];
        if (v >= count)
          fail(fmt::format("triangle {} names vertex {}, but there are only {} vertices", i, v,
                           count));
        if (!finite(source_.positions[v]))
          fail(fmt::format("the position of vertex {} is not finite", v));
        if (!finite(source_.uvs[v])) fail(fmt::format("the uv of vertex {} is not finite", v));
      }
  }

  bool hasArea(const glm::uvec3& t) const {
    const glm::dvec3 p = source_.positions[t.x];
    glm::dvec3 e1 = source_.positions[t.y] - p, e2 = source_.positions[t.z] - p;
    const double size = std::max(glm::length(e1), glm::length(e2));
    if (!(size > 0) || !std::isfinite(size)) return false;
    return glm::length(glm::cross(e1 / size, e2 / size)) > 0;
  }

  void dropEmptyTriangles() {
    std::size_t kept = 0;
    const std::size_t all = source_.triangles.size();
    for (std::size_t i = 0; i < all; ++i) {
      if (!hasArea(source_.triangles[i])) continue;
      source_.triangles[kept] = glm::uvec3(source_.triangles[i]);
      source_.triangle_parts[kept++] = source_.triangle_parts[i];
    }
    if (kept == 0) fail("no triangle of the mesh has an area, expected at least one");
    if (kept < all)
      source_.notes.push_back(fmt::format("{} of {} triangles of {} have no area and were left out",
                                          all - kept, all, short_name_));
    source_.triangles.resize(kept);
    source_.triangle_parts.resize(kept);
  }

  /// One vertex for all that are alike, in the order in which triangles name them.
  void joinVertices() {
    const std::size_t count = source_.positions.size();
    std::vector<std::uint32_t> to(count, kNoIndex);
    {
      VertexTable table(count);
      const bool grouped = !source_.smoothing.empty();
      const auto hash = [&](std::uint32_t v) {
        std::uint64_t value = 0;
        for (int i = 0; i < 3; ++i)
          value = mixedHash(value, std::bit_cast<std::uint64_t>(source_.positions[v][i] + 0.0));
        if (grouped) value = mixedHash(value, source_.smoothing[v]);
        for (int i = 0; i < 2; ++i)
          value = mixedHash(value, std::bit_cast<std::uint64_t>(source_.uvs[v][i] + 0.0));
        return value;
      };
      const auto equal = [&](std::uint32_t a, std::uint32_t b) {
        return source_.positions[a] == source_.positions[b] && source_.uvs[a] == source_.uvs[b] &&
               source_.normals[a] == source_.normals[b] &&
               (!grouped || source_.smoothing[a] == source_.smoothing[b]);
      };
      for (glm::uvec3& t : source_.triangles)
        for (int k = 0; k < 3; ++k) t[k] = table.findOrAdd(t[k], hash, equal);
    }
    std::uint32_t next = 0;
    for (glm::uvec3& t : source_.triangles)
      for (int k = 0; k < 3; ++k) {
        if (to[t[k]] == kNoIndex) to[t[k]] = next++;
        t[k] = to[t[k]];
      }
    permute(source_.positions, to, next);
    permute(source_.normals, to, next);
    permute(source_.uvs, to, next);
    if (!source_.smoothing.empty()) permute(source_.smoothing, to, next);
  }

  template <typename T>
  static void permute(std::vector<T>& values, const std::vector<std::uint32_t>& to,
                      std::size_t count) {
    std::vector<T> moved(count);
    for (std::size_t i = 0; i < to.size(); ++i)
      if (to[i] != kNoIndex) moved[to[i]] = values[i];
    values = std::move(moved);
  }

  /// Positions as floats; moved and scaled first if that is needed and wanted.
  void place(TriangleMesh& mesh) {
    glm::dvec3 low = source_.positions[0], high = low;
    for (const glm::dvec3& p : source_.positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::dvec3 size = high - low, far = glm::max(glm::abs(low), glm::abs(high));
    const double side = std::max({size.x, size.y, size.z}),
                 distance = std::max({far.x, far.y, far.z});
    if (!std::isfinite(side)) fail("the mesh is larger than a number of double precision can say");
    glm::dvec3 origin(0);
    bool scaled = false;
    if (options_.place_freely && distance > kFarAway * side) {
      origin = 0.5 * (low + high);
      source_.notes.push_back(fmt::format("{} was moved by ({:.6g}, {:.6g}, {:.6g}) to the origin",
                                          short_name_, -origin.x, -origin.y, -origin.z));
    }
    if (options_.place_freely && (side < kSmallestSide || side > kLargestSide)) {
      scaled = true;
      source_.notes.push_back(
          fmt::format("{} was made 1 long; its longest side is {:.6g}", short_name_, side));
    }
    mesh.positions.reserve(source_.positions.size());
    for (const glm::dvec3& p : source_.positions) {
      const glm::dvec3 moved = p - origin;
      mesh.positions.emplace_back(scaled ? moved / side : moved);
    }
    source_.positions = {};
  }

  MeshSource source_;
  std::string name_, short_name_;
  ImportOptions options_;
};

}  // namespace

PartMesh finishMesh(MeshSource source, const std::string& source_name,
                    const ImportOptions& options) {
  return MeshFinisher(std::move(source), source_name, options).run();
}

}  // namespace glintmark
