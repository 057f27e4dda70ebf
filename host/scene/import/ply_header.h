// What the header of a PLY file promises.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glintmark {

enum class PlyFormat { kText, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;  // of a list: of its elements
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of a list only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Position of the first property of one of those names; -1 for none.
  int find(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kText;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  // where the elements begin
};

/// Bytes of a number in a binary file.
std::size_t plyTypeBytes(PlyType type);

/// Reads the header of a whole PLY file; lines may end in \n, \r\n or \r. Throws Error naming
/// `source` if there is no whole header, if it holds what the format does not know, or if `text` is
/// too short for the elements that it counts. [Turk, "The PLY Polygon File Format", 1994]
PlyHeader readPlyHeader(std::string_view text, const std::string& source);

}  // namespace glintmark
