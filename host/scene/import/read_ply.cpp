#include "host/scene/import/read_ply.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "host/core/error.h"
#include "host/scene/import/ply_header.h"
#include "host/scene/import/ply_numbers.h"
#include "host/scene/import/text_scanner.h"
#include "host/scene/import/triangulate.h"

namespace glintmark {
namespace {

constexpr std::uint64_t kMostElements = 0xFFFFFFF0u;

/// Where the numbers of a vertex stand among its properties; -1: nowhere.
struct VertexLayout {
  std::array<int, 3> position{-1, -1, -1}, normal{-1, -1, -1};
  std::array<int, 2> uv{-1, -1};

  explicit VertexLayout(const PlyElement& element) {
    // A list of numbers is none.
    const auto find = [&](std::initializer_list<std::string_view> names) {
      const int found = element.find(names);
      return found >= 0 && element.properties[found].is_list ? -1 : found;
    };
    position = {find({"x"}), find({"y"}), find({"z"})};
    normal = {find({"nx", "normal_x"}), find({"ny", "normal_y"}), find({"nz", "normal_z"})};
    constexpr std::pair<const char*, const char*> kNames[] = {{"u", "v"},
                                                              {"s", "t"},
                                                              {"texture_u", "texture_v"},
                                                              {"texture_s", "texture_t"},
                                                              {"texcoord_u", "texcoord_v"},
                                                              {"u0", "v0"}};
    for (const auto& [u, v] : kNames) {
      uv = {find({u}), find({v})};
      if (uv[0] >= 0 && uv[1] >= 0) return;
    }
    uv = {-1, -1};
  }

  bool hasNormal() const { return normal[0] >= 0 && normal[1] >= 0 && normal[2] >= 0; }
};

class PlyReader {
 public:
  PlyReader(std::string text, const std::string& source)
      : text_(std::move(text)),
        source_(source),
        header_(readPlyHeader(text_, source_)),
        numbers_(std::string_view(text_).substr(header_.bytes), header_.format, source_) {}

  MeshSource run() {
    out_.parts.emplace_back("");
    for (const PlyElement& element : header_.elements) {
      if (element.count > kMostElements)
        fail(fmt::format("has {} elements {}, more than 4294967279", element.count, element.name));
      if (element.name == "vertex") {
        readVertices(element);
      } else if (element.name == "face" || element.name == "tristrips") {
        readFaces(element);
      } else if (!element.properties.empty()) {
        for (std::uint64_t i = 0; i < element.count; ++i) readRow(element);
      }
    }
    checkIndices();
    text_ = {};
    if (has_wedges_) spreadWedges();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("{}: {}", source_, reason));
  }

  /// The numbers of one element into row_, one per property; those of lists into lists_.
  void readRow(const PlyElement& element) {
    row_.resize(element.properties.size());
    lists_.resize(element.properties.size());
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (!property.is_list) {
        row_[i] = numbers_.next(property.type);
        continue;
      }
      lists_[i].resize(numbers_.nextCount(property));
      for (double& value : lists_[i]) value = numbers_.next(property.type);
    }
    numbers_.endElement();
  }

  void readVertices(const PlyElement& element) {
    const VertexLayout layout(element);
    for (int axis = 0; axis < 3; ++axis)
      if (layout.position[axis] < 0)
        fail(
            fmt::format("cannot be read as a mesh: its vertices have no property {}", "xyz"[axis]));
    const bool has_uv = layout.uv[0] >= 0, has_normal = layout.hasNormal();
    out_.positions.reserve(element.count);
    out_.normals.reserve(element.count);
    out_.uvs.reserve(element.count);
    const auto at = [&](int i) { return row_[i]; };
    for (std::uint64_t i = 0; i < element.count; ++i) {
      readRow(element);
      out_.positions.emplace_back(at(layout.position[0]), at(layout.position[1]),
                                  at(layout.position[2]));
      out_.normals.push_back(
          has_normal ? glm::vec3(at(layout.normal[0]), at(layout.normal[1]), at(layout.normal[2]))
                     : glm::vec3(0));
      // v runs up in PLY files, as in those of the programs that write them.
      out_.uvs.push_back(has_uv ? glm::dvec2(at(layout.uv[0]), 1 - at(layout.uv[1])) : kNoUv);
    }
  }

  void readFaces(const PlyElement& element) {
    // Nothing of them is in the file, however many its header counts.
    if (element.properties.empty()) return;
    const int indices = element.find({"vertex_indices", "vertex_index"});
    const int wedges = element.find({"texcoord"});
    const bool strips = element.name == "tristrips";
    if (indices >= 0 && !strips) out_.triangles.reserve(out_.triangles.size() + element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      readRow(element);
      if (indices < 0 || !element.properties[indices].is_list) continue;
      if (strips) {
        addStrip(lists_[indices], i);
      } else {
        addPolygon(lists_[indices], wedges >= 0 ? lists_[wedges] : std::vector<double>(), i);
      }
    }
  }

  std::uint32_t indexOf(double value, std::uint64_t face) {
    if (!(value >= 0) || value > static_cast<double>(kMostElements))
      fail(fmt::format("face {} names vertex {}, expected one from 0 on", face, value));
    const auto index = static_cast<std::uint32_t>(value);
    if (index >= largest_index_ || largest_face_ == kNobody)
      largest_index_ = index, largest_face_ = face;
    return index;
  }

  void addPolygon(const std::vector<double>& indices, const std::vector<double>& wedges,
                  std::uint64_t face) {
    if (indices.empty()) fail(fmt::format("face {} of the mesh has no vertices", face));
    polygon_.clear();
    corners_.clear();
    for (const double value : indices) {
      polygon_.push_back(indexOf(value, face));
      const std::uint32_t vertex = polygon_.back();
      corners_.push_back(vertex < out_.positions.size() ? out_.positions[vertex] : glm::dvec3(0));
    }
    pieces_.clear();
    triangulate(corners_, pieces_);
    const bool has_wedges = wedges.size() == 2 * indices.size();
    has_wedges_ = has_wedges_ || has_wedges;
    for (const auto& piece : pieces_) {
      out_.triangles.emplace_back(polygon_[piece[0]], polygon_[piece[1]], polygon_[piece[2]]);
      out_.triangle_parts.push_back(0);
      if (!has_wedges_) continue;
      wedge_uvs_.resize(3 * (out_.triangles.size() - 1), kNoUv);
      for (const int corner : piece)
        wedge_uvs_.push_back(has_wedges ? glm::dvec2(wedges[2 * corner], 1 - wedges[2 * corner + 1])
                                        : kNoUv);
    }
  }

  /// Every index after the second closes a triangle; a negative one starts anew.
  void addStrip(const std::vector<double>& indices, std::uint64_t strip) {
    polygon_.clear();
    for (const double value : indices) {
      if (value < 0) {
        polygon_.clear();
        continue;
      }
      polygon_.push_back(indexOf(value, strip));
      const std::size_t n = polygon_.size();
      if (n < 3) continue;
      const bool odd = n % 2 == 0;
      out_.triangles.emplace_back(polygon_[n - (odd ? 2 : 3)], polygon_[n - (odd ? 3 : 2)],
                                  polygon_[n - 1]);
      out_.triangle_parts.push_back(0);
    }
  }

  void checkIndices() const {
    if (largest_face_ != kNobody && largest_index_ >= out_.positions.size())
      fail(fmt::format("face {} of the mesh names vertex {}, but there are only {}", largest_face_,
                       largest_index_, out_.positions.size()));
  }

  /// Gives every corner a vertex of its own; equal ones are joined later.
  void spreadWedges() {
    wedge_uvs_.resize(3 * out_.triangles.size(), kNoUv);
    MeshSource spread;
    spread.positions.reserve(wedge_uvs_.size());
    spread.normals.reserve(wedge_uvs_.size());
    for (glm::uvec3& triangle : out_.triangles)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = triangle[k];
        triangle[k] = static_cast<std::uint32_t>(spread.positions.size());
        glm::dvec2& uv = wedge_uvs_[triangle[k]];
        if (uv == kNoUv) uv = out_.uvs[vertex];
        spread.positions.push_back(glm::dvec3(out_.positions[vertex]));
        spread.normals.push_back(glm::vec3(out_.normals[vertex]));
      }
    out_.positions = std::move(spread.positions);
    out_.normals = std::move(spread.normals);
    out_.uvs = std::move(wedge_uvs_);
  }

  static constexpr std::uint64_t kNobody = ~std::uint64_t{0};

  std::string text_;
  std::string source_;
  PlyHeader header_;
  PlyNumbers numbers_;
  std::vector<double> row_;
  std::vector<std::vector<double>> lists_;
  std::vector<std::uint32_t> polygon_;
  std::vector<glm::dvec3> corners_;
  std::vector<std::array<int, 3>> pieces_;
  bool has_wedges_ = false;
  std::vector<glm::dvec2> wedge_uvs_;  // per corner of the triangles so far, once a face has some
  std::uint32_t largest_index_ = 0;
  std::uint64_t largest_face_ = kNobody;
  MeshSource out_;
};

}  // namespace

MeshSource readPly(std::string text, const std::string& source) {
  return PlyReader(std::move(text), source).run();
}

}  // namespace glintmark
