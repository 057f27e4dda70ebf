#include "host/scene/import/read_obj.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "host/core/error.h"
#include "host/scene/import/distinct_values.h"
#include "host/scene/import/mesh_source.h"
#include "host/scene/import/text_scanner.h"
#include "host/scene/import/triangulate.h"
#include "host/scene/import/vertex_table.h"

namespace glintmark {
namespace {

constexpr std::uint32_t kFlat = 0;  // smoothing group 0; faces before any `s` are in group 1
constexpr std::size_t kMostVertices = 0xFFFFFFF0u;

/// A vertex of the mesh: what of each list a corner names.
struct Corner {
  std::uint32_t position = 0, uv = kNoIndex, normal = kNoIndex;
  std::uint32_t group = 1;  // smoothing group; of flat faces: kNoIndex less the face's number

  bool operator==(const Corner&) const = default;
  std::uint64_t hash() const {
    return mixedHash(mixedHash(0, static_cast<std::uint64_t>(position) << 32 | uv),
                     static_cast<std::uint64_t>(normal) << 32 | group);
  }
};

class ObjReader {
 public:
  ObjReader(std::string text, const std::string& source)
      : text_(std::move(text)), source_(source) {}

  MeshSource run() {
    LineReader lines(text_);
    std::string joined;
    for (std::string_view line; lines.next(line);) {
      line_ = lines.number();
      if (line.ends_with('\\')) {
        joined.assign(line.substr(0, line.size() - 1));
        while (line.ends_with('\\') && lines.next(line)) {
          joined += ' ';
          joined += line.substr(0, line.size() - (line.ends_with('\\') ? 1 : 0));
        }
        line = joined;
      }
      if (const std::size_t comment = line.find('#'); comment != std::string_view::npos)
        if (comment == 0 || line[comment - 1] == ' ' || line[comment - 1] == '\t')
          line = line.substr(0, comment);
      readLine(line);
    }
    text_ = {};
    checkReferences();
    if (out_.triangles.empty() && has_free_form_)
      throw Error(source_ + ": the mesh has no triangles, only curves and free-form surfaces");
    if (out_.triangles.empty() && positions_.empty())
      throw Error(source_ + ": cannot be read as a mesh: it has no vertices");
    fillVertices();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("{}:{}: {}", source_, line_, reason));
  }

  void readLine(std::string_view line) {
    const std::string_view key = takeWord(line);
    if (key == "v") {
      positions_.push_back(readVector<3>(line, key, 3));
    } else if (key == "vt") {
      const glm::dvec2 uv = readVector<2>(line, key, 1);
      uvs_.emplace_back(uv.x, 1 - uv.y);
    } else if (key == "vn") {
      normals_.push_back(glm::vec3(readVector<3>(line, key, 3)));
    } else if (key == "f" || key == "fo") {
      readFace(line);
    } else if (key == "usemtl") {
      const std::size_t begin = line.find_first_not_of(" \t");
      std::string name(begin == std::string_view::npos ? "" : line.substr(begin));
      while (!name.empty() && (name.back() == ' ' || name.back() == '\t')) name.pop_back();
      part_ = out_.part(name);
    } else if (key == "s") {
      const std::string_view word = takeWord(line);
      group_ = word == "off" ? kFlat : wholeNumber(word).value_or(1);
    } else if (key == "curv" || key == "surf" || key == "curv2") {
      has_free_form_ = true;
    }
  }

  static std::optional<int> wholeNumber(std::string_view word) {
    int value = 0;
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size()) return std::nullopt;
    return value;
  }

  template <int kCount>
  glm::vec<kCount, double> readVector(std::string_view line, std::string_view key,
                                      int least) const {
    glm::vec<kCount, double> value(0);
    for (int i = 0; i < kCount; ++i) {
      const std::string_view word = takeWord(line);
      if (word.empty() && i >= least) break;
      const std::optional<double> number = parseNumber(word);
      if (!number)
        fail(fmt::format("'{}' of {} is not a number, expected {} of them", word, key, kCount));
      value[i] = *number;
    }
    return value;
  }

  /// Position in a list of `count` so far; lists may grow to hold it later.
  std::uint32_t reference(std::string_view word, std::size_t count) const {
    const std::optional<int> index = wholeNumber(word);
    if (!index) fail(fmt::format("'{}' of a face is not the number of a vertex", word));
    const std::int64_t position =
        *index > 0 ? *index - 1LL : static_cast<std::int64_t>(count) + *index;
    if (*index == 0 || position < 0)
      fail(
          fmt::format("a face names vertex {}, an index out of range: there are {} before it, "
                      "counted from 1 or back from -1",
                      *index, count));
    return static_cast<std::uint32_t>(position);
  }

  Corner readCorner(std::string_view word) const {
    Corner corner;
    const std::size_t first = std::min(word.find('/'), word.size());
    corner.position = reference(word.substr(0, first), positions_.size());
    if (first == word.size()) return corner;
    word.remove_prefix(first + 1);
    const std::size_t second = std::min(word.find('/'), word.size());
    if (second > 0) corner.uv = reference(word.substr(0, second), uvs_.size());
    if (second + 1 < word.size())
      corner.normal = reference(word.substr(second + 1), normals_.size());
    return corner;
  }

  void readFace(std::string_view line) {
    face_.clear();
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
      face_.push_back(readCorner(word));
    if (face_.size() < 3) {
      if (face_.empty()) fail("a face has no vertices");
      return;  // a point or a line
    }
    bool has_uvs = true, has_normals = true;
    for (const Corner& corner : face_) {
      has_uvs = has_uvs && corner.uv != kNoIndex;
      has_normals = has_normals && corner.normal != kNoIndex;
    }
    ++faces_;
    corners_of_face_.clear();
    flat_.clear();
    for (Corner& corner : face_) {
      if (!has_uvs) corner.uv = kNoIndex;
      if (!has_normals) corner.normal = kNoIndex;
      corner.group = has_normals ? 1 : group_ == kFlat ? kNoIndex - faces_ : group_;
      corners_of_face_.push_back(vertexOf(corner));
      flat_.push_back(corner.position < positions_.size() ? positions_[corner.position]
                                                          : glm::dvec3(0));
    }
    if (!part_) part_ = out_.part("DefaultMaterial");
    pieces_.clear();
    triangulate(flat_, pieces_);
    for (const auto& [a, b, c] : pieces_) {
      out_.triangles.emplace_back(corners_of_face_[a], corners_of_face_[b], corners_of_face_[c]);
      out_.triangle_parts.push_back(*part_);
    }
  }

  std::uint32_t vertexOf(const Corner& wanted) {
    last_position_ = std::max(last_position_, wanted.position);
    if (wanted.uv != kNoIndex && (last_uv_ == kNoIndex || wanted.uv > last_uv_))
      last_uv_ = wanted.uv;
    if (wanted.normal != kNoIndex && (last_normal_ == kNoIndex || wanted.normal > last_normal_))
      last_normal_ = wanted.normal;
    if (corners_.size() >= kMostVertices) fail("the mesh has more vertices than 4294967279");
    return corners_.add(wanted);
  }

  void checkReferences() const {
    const auto check = [&](std::uint32_t last, std::size_t count, const char* what) {
      if (last == kNoIndex || last < count) return;
      throw Error(fmt::format("{}: a face names {} {}, an index out of range: the file has {}",
                              source_, what, last + std::size_t{1}, count));
    };
    if (corners_.size() > 0) check(last_position_, positions_.size(), "vertex");
    // Programs write the numbers of lists that they leave out.
    if (!uvs_.empty()) check(last_uv_, uvs_.size(), "uv");
    if (!normals_.empty()) check(last_normal_, normals_.size(), "normal");
  }

  void fillVertices() {
    const auto note = [&](bool wrong, const char* what) {
      if (wrong)
        out_.notes.push_back(fmt::format("faces of {} name {}, of which it has none",
                                         std::filesystem::path(source_).filename().string(), what));
    };
    note(uvs_.empty() && last_uv_ != kNoIndex, "uvs");
    note(normals_.empty() && last_normal_ != kNoIndex, "normals");
    const std::vector<Corner> corners = corners_.take();
    const std::size_t count = corners.size();
    out_.positions.reserve(count);
    out_.normals.reserve(count);
    out_.uvs.reserve(count);
    out_.smoothing.reserve(count);
    for (const Corner& corner : corners) {
      const bool has_normal = corner.normal != kNoIndex && !normals_.empty();
      const bool has_uv = corner.uv != kNoIndex && !uvs_.empty();
      out_.positions.push_back(positions_[corner.position]);
      out_.normals.push_back(has_normal ? normals_[corner.normal] : glm::vec3(0));
      out_.uvs.push_back(has_uv ? uvs_[corner.uv] : kNoUv);
      out_.smoothing.push_back(corner.group);
    }
  }

  std::string text_;
  std::string source_;
  std::size_t line_ = 0;
  std::uint32_t faces_ = 0, group_ = 1;
  std::optional<std::uint32_t> part_;
  bool has_free_form_ = false;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::dvec2> uvs_;
  std::vector<glm::vec3> normals_;
  DistinctValues<Corner> corners_;
  std::uint32_t last_position_ = 0, last_uv_ = kNoIndex, last_normal_ = kNoIndex;
  // Of one face, kept for their memory.
  std::vector<Corner> face_;
  std::vector<std::uint32_t> corners_of_face_;
  std::vector<glm::dvec3> flat_;
  std::vector<std::array<int, 3>> pieces_;
  MeshSource out_;
};

}  // namespace

MeshSource readObj(std::string text, const std::string& source) {
  return ObjReader(toUtf8(std::move(text)), source).run();
}

}  // namespace glintmark
