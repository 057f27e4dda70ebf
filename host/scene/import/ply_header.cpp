#include "host/scene/import/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "host/core/error.h"
#include "host/scene/import/text_scanner.h"

namespace glintmark {
namespace {

std::string printable(std::string_view word) {
  std::string text(word.substr(0, 40));
  std::ranges::replace_if(
      text, [](char c) { return c < ' '; }, '?');
  return text;
}

[[noreturn]] void fail(const std::string& source, const std::string& reason) {
  throw Error(fmt::format("{}: cannot be read as a mesh: {}", source, reason));
}

PlyType typeOf(std::string_view word, const std::string& source) {
  constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::kInt8},     {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},   {"short", PlyType::kInt16},   {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16}, {"uint16", PlyType::kUint16}, {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},   {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat},   {"float32", PlyType::kFloat}, {"double", PlyType::kDouble},
      {"float64", PlyType::kDouble}};
  for (const auto& [name, type] : kNames)
    if (name == word) return type;
  fail(source, fmt::format("a property of its header has the type '{}', which PLY does not know",
                           printable(word)));
}

PlyFormat formatOf(std::string_view word, const std::string& source) {
  if (word == "ascii") return PlyFormat::kText;
  if (word == "binary_little_endian") return PlyFormat::kLittleEndian;
  if (word == "binary_big_endian") return PlyFormat::kBigEndian;
  fail(source, fmt::format("its format is '{}', expected ascii, binary_little_endian or "
                           "binary_big_endian",
                           printable(word)));
}

void addElement(PlyHeader& header, std::string_view line, const std::string& source) {
  PlyElement element;
  element.name = takeWord(line);
  const std::string_view word = takeWord(line);
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), element.count);
  if (error != std::errc() || stop != word.data() + word.size())
    fail(source, fmt::format("element {} has no count", printable(element.name)));
  header.elements.push_back(std::move(element));
}

void addProperty(PlyHeader& header, std::string_view line, const std::string& source) {
  if (header.elements.empty()) fail(source, "its header has a property before any element");
  PlyProperty property;
  std::string_view word = takeWord(line);
  property.is_list = word == "list";
  if (property.is_list) {
    property.count_type = typeOf(takeWord(line), source);
    word = takeWord(line);
  }
  property.type = typeOf(word, source);
  property.name = takeWord(line);
  header.elements.back().properties.push_back(std::move(property));
}

/// Every number takes at least one byte, in text a separator too.
void checkSize(const PlyHeader& header, std::size_t size, const std::string& source) {
  double least_bytes = 0;
  for (const PlyElement& element : header.elements) {
    double bytes_of_one = 0;
    for (const PlyProperty& property : element.properties) {
      const PlyType least = property.is_list ? property.count_type : property.type;
      bytes_of_one +=
          header.format == PlyFormat::kText ? 2 : static_cast<double>(plyTypeBytes(least));
    }
    least_bytes += static_cast<double>(element.count) * bytes_of_one;
  }
  // The last number needs no separator.
  if (least_bytes > static_cast<double>(size - header.bytes) + 1)
    fail(source, "it ends before the elements that its header counts");
}

}  // namespace

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (const std::string_view wanted : names)
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == wanted) return static_cast<int>(i);
  return -1;
}

std::size_t plyTypeBytes(PlyType type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<int>(type)];
}

PlyHeader readPlyHeader(std::string_view text, const std::string& source) {
  PlyHeader header;
  LineReader lines(text);
  std::string_view line;
  bool has_format = false;
  if (!lines.next(line) || takeWord(line) != "ply") fail(source, "it does not begin with 'ply'");
  while (lines.next(line)) {
    const std::string_view key = takeWord(line);
    if (key == "format") {
      header.format = formatOf(takeWord(line), source);
      has_format = true;
    } else if (key == "element") {
      addElement(header, line, source);
    } else if (key == "property") {
      addProperty(header, line, source);
    } else if (key == "end_header") {
      if (!has_format) fail(source, "its header names no format");
      header.bytes = text.size() - lines.rest().size();
      checkSize(header, text.size(), source);
      return header;
    }
    // Beside comment and obj_info, remarks stand there that nothing announces.
  }
  fail(source, "it has no whole PLY header");
}

}  // namespace glintmark
