#include "host/scene/import/read_stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/scene/import/distinct_values.h"
#include "host/scene/import/text_scanner.h"
#include "host/scene/import/vertex_table.h"

namespace glintmark {
namespace {

constexpr std::size_t kHeadBytes = 84, kTriangleBytes = 50;
constexpr std::size_t kTrianglesAtOnce = 20000;
constexpr std::size_t kTextBytesAtOnce = 1 << 20;
constexpr std::size_t kLongestWord = 4096;
constexpr std::size_t kMostTriangles = 0xFFFFFFF0u / 3;

/// A place, and the number of the surface through it that a corner belongs to.
struct StlCorner {
  glm::vec3 place;
  std::uint32_t surface = 0;

  // By bits: places that are no numbers, equal to nothing, would make the table a list. + 0: the
  // two zeros are one place.
  std::array<std::uint32_t, 3> bits() const {
    std::array<std::uint32_t, 3> words{};
    for (int i = 0; i < 3; ++i)
      words[static_cast<std::size_t>(i)] = std::bit_cast<std::uint32_t>(place[i] + 0.0f);
    return words;
  }
  bool operator==(const StlCorner& other) const {
    return surface == other.surface && bits() == other.bits();
  }
  std::uint64_t hash() const {
    std::uint64_t value = surface;
    for (const std::uint32_t word : bits()) value = mixedHash(value, word);
    return value;
  }
};

class StlReader {
 public:
  explicit StlReader(const std::filesystem::path& file) : source_(file.string()), file_(file) {}

  MeshSource run() {
    piece_.resize(kHeadBytes + 1024);
    piece_.resize(file_.read(piece_.data(), piece_.size()));
    if (isText()) {
      readText();
    } else {
      readBinary();
    }
    first_normals_ = {};
    std::vector<StlCorner> corners = corners_.take();
    out_.normals.assign(corners.size(), glm::vec3(0));
    out_.uvs.assign(corners.size(), kNoUv);
    out_.positions.reserve(corners.size());
    out_.smoothing.reserve(corners.size());
    for (const StlCorner& corner : corners) {
      out_.positions.emplace_back(corner.place);
      out_.smoothing.push_back(corner.surface);
    }
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(fmt::format("{}: cannot be read as a mesh: {}", source_, reason));
  }

  /// Programs begin binary files with "solid" too, which only texts should.
  bool isText() const {
    const std::string_view head(piece_);
    const std::size_t begin = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (begin == std::string_view::npos || !isWord(head.substr(begin, 5), "solid")) return false;
    if (head.size() >= kHeadBytes && file_.sizeBytes() == kHeadBytes + count() * kTriangleBytes)
      return false;
    return head.find('\0') == std::string_view::npos;
  }

  static bool isWord(std::string_view word, std::string_view wanted) {
    return std::ranges::equal(word, wanted, [](char a, char b) { return (a | ' ') == b; });
  }

  std::uint64_t count() const {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
      value = value << 8 | static_cast<unsigned char>(piece_[80 + i]);
    return value;
  }

  void readBinary() {
    if (piece_.size() < kHeadBytes)
      fail(
          fmt::format("it is neither a text that begins with 'solid' nor as long as the {} bytes "
                      "before the triangles of a binary file",
                      kHeadBytes));
    const std::uint64_t triangles = count();
    const std::uint64_t there = (file_.sizeBytes() - kHeadBytes) / kTriangleBytes;
    if (triangles > there)
      fail(fmt::format("it ends after {} of the {} triangles that its header counts", there,
                       triangles));
    startPart("DefaultMaterial");
    out_.triangles.reserve(triangles);
    out_.triangle_parts.reserve(triangles);
    piece_.erase(0, kHeadBytes);
    for (std::uint64_t done = 0; done < triangles;) {
      const std::size_t wanted = std::min<std::uint64_t>(triangles - done, kTrianglesAtOnce);
      const std::size_t had = std::min(piece_.size(), wanted * kTriangleBytes);
      std::string rest = piece_.substr(had);
      piece_.resize(wanted * kTriangleBytes);
      const std::size_t got = had + file_.read(piece_.data() + had, piece_.size() - had);
      if (got < piece_.size()) fail("it ends within a triangle");
      for (std::size_t i = 0; i < wanted; ++i) addTriangle(cornersAt(i * kTriangleBytes + 12));
      done += wanted;
      piece_ = std::move(rest);
    }
  }

  std::array<glm::vec3, 3> cornersAt(std::size_t at) const {
    std::array<std::uint32_t, 9> words{};
    std::memcpy(words.data(), piece_.data() + at, sizeof words);
    std::array<glm::vec3, 3> corners;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if constexpr (std::endian::native == std::endian::big) words[i] = __builtin_bswap32(words[i]);
      corners[i / 3][static_cast<int>(i % 3)] = std::bit_cast<float>(words[i]);
    }
    return corners;
  }

  void readText() {
    if (piece_.starts_with("\xEF\xBB\xBF")) piece_.erase(0, 3);
    std::vector<glm::vec3> polygon;
    for (std::string_view word = nextWord(); !word.empty(); word = nextWord()) {
      if (isWord(word, "solid")) {
        startPart(restOfLine());
      } else if (isWord(word, "vertex")) {
        glm::vec3 place;
        for (int i = 0; i < 3; ++i) place[i] = nextNumber();
        polygon.push_back(place);
      } else if (isWord(word, "outer") || isWord(word, "endloop") || isWord(word, "endfacet")) {
        if (polygon.size() == 1 || polygon.size() == 2)
          fail(fmt::format("line {} ends a facet of {} vertices, expected three", line_,
                           polygon.size()));
        for (std::size_t i = 2; i < polygon.size(); ++i)
          addTriangle({polygon[0], polygon[i - 1], polygon[i]});
        polygon.clear();
      } else if (isWord(word, "endsolid")) {
        restOfLine();
      }
    }
    if (!polygon.empty()) fail("it ends within a triangle");
  }

  /// The next word of the text, of up to kLongestWord bytes; empty at its end.
  std::string_view nextWord() {
    for (;; ++at_) {
      if (!hasByte()) return {};
      if (!isSpace(piece_[at_])) break;
      line_ += piece_[at_] == '\n';
    }
    std::size_t end = at_;
    while (end < piece_.size() && !isSpace(piece_[end])) ++end;
    if (end == piece_.size() && hasByte(kLongestWord))
      for (end = at_; end < piece_.size() && !isSpace(piece_[end]);) ++end;
    const std::string_view word = std::string_view(piece_).substr(at_, end - at_);
    if (word.size() >= kLongestWord)
      fail(fmt::format("line {} has a word of {} bytes or more", line_, kLongestWord));
    at_ = end;
    return word;
  }

  float nextNumber() {
    const std::string_view word = nextWord();
    if (word.empty()) fail("it ends within a triangle");
    const std::optional<double> value = parseNumber(word);
    if (!value)
      fail(fmt::format("line {}: '{}' of a vertex is not a number", line_, word.substr(0, 40)));
    return static_cast<float>(*value);
  }

  /// Without blanks around it, cut at kLongestWord bytes.
  std::string restOfLine() {
    std::string text;
    for (; hasByte() && piece_[at_] != '\n'; ++at_)
      if (text.size() < kLongestWord && (!text.empty() || !isSpace(piece_[at_])))
        text += piece_[at_];
    while (!text.empty() && isSpace(text.back())) text.pop_back();
    return text;
  }

  /// Whether `more` bytes follow, which are read if need be.
  bool hasByte(std::size_t more = 1) {
    if (at_ + more > piece_.size()) {
      piece_.erase(0, at_);
      at_ = 0;
      const std::size_t had = piece_.size();
      piece_.resize(had + kTextBytesAtOnce);
      piece_.resize(had + file_.read(piece_.data() + had, kTextBytesAtOnce));
    }
    return at_ < piece_.size();
  }

  static bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void startPart(const std::string& name) {
    part_ = out_.part(name.empty() ? "DefaultMaterial" : name);
  }

  void addTriangle(const std::array<glm::vec3, 3>& places) {
    if (out_.triangles.size() >= kMostTriangles)
      fail(fmt::format("it has more than {} triangles", kMostTriangles));
    if (out_.parts.empty()) startPart("");
    const glm::dvec3 a = places[0];
    const glm::dvec3 area = glm::cross(glm::dvec3(places[1]) - a, glm::dvec3(places[2]) - a);
    const double length = glm::length(area);
    const glm::vec3 normal = length > 0 && std::isfinite(length) ? area / length : glm::dvec3(0);
    glm::uvec3 triangle;
    for (int k = 0; k < 3; ++k) triangle[k] = vertexOf(places[static_cast<std::size_t>(k)], normal);
    out_.triangles.push_back(triangle);
    out_.triangle_parts.push_back(part_);
  }

  std::uint32_t vertexOf(const glm::vec3& place, const glm::vec3& normal) {
    static const float kLeastCosine = static_cast<float>(std::cos(glm::radians(kStlCrease_deg)));
    for (StlCorner corner{place};; ++corner.surface) {
      const std::uint32_t vertex = corners_.add(corner);
      if (vertex == first_normals_.size()) first_normals_.push_back(normal);
      glm::vec3& first = first_normals_[vertex];
      if (first == glm::vec3(0)) first = normal;
      if (normal == glm::vec3(0) || glm::dot(first, normal) >= kLeastCosine) return vertex;
    }
  }

  std::string source_;
  InputFile file_;
  std::string piece_;     // of the file
  std::size_t at_ = 0;    // in a piece of text
  std::size_t line_ = 1;  // of the text
  std::uint32_t part_ = 0;
  DistinctValues<StlCorner> corners_;
  std::vector<glm::vec3> first_normals_;  // per vertex, of its first triangle
  MeshSource out_;
};

}  // namespace

MeshSource readStl(const std::filesystem::path& file) {
  return StlReader(file).run();
}

}  // namespace glintmark
