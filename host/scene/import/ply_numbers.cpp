#include "host/scene/import/ply_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "host/core/error.h"
#include "host/scene/import/text_scanner.h"

namespace glintmark {
namespace {

template <typename T>
double valueOf(const char* bytes, bool swap) {
  char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (swap) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return static_cast<double>(value);
}

[[noreturn]] void failAtEnd(const std::string& source) {
  throw Error(source +
              ": cannot be read as a mesh: it ends before the elements that its header counts");
}

bool isSpace(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

double PlyNumbers::next(PlyType type) {
  return format_ == PlyFormat::kText ? nextWord() : nextBinary(type);
}

std::size_t PlyNumbers::nextCount(const PlyProperty& list) {
  const double count = next(list.count_type);
  const double bytes =
      format_ == PlyFormat::kText ? 2 : static_cast<double>(plyTypeBytes(list.type));
  if (!(count >= 0))
    throw Error(*source_ + ": cannot be read as a mesh: a list has a negative count");
  if (count * bytes > static_cast<double>(rest_.size()) + 1) failAtEnd(*source_);
  return static_cast<std::size_t>(count);
}

void PlyNumbers::endElement() {
  if (format_ == PlyFormat::kText)
    rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
}

double PlyNumbers::nextWord() {
  std::size_t begin = 0;
  while (begin < rest_.size() && isSpace(rest_[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest_.size() && !isSpace(rest_[end])) ++end;
  if (begin == end) failAtEnd(*source_);
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  const std::optional<double> value = parseNumber(word);
  if (!value)
    throw Error(fmt::format("{}: cannot be read as a mesh: '{}' is not a number", *source_,
                            word.substr(0, 40)));
  return *value;
}

double PlyNumbers::nextBinary(PlyType type) {
  const std::size_t size = plyTypeBytes(type);
  if (rest_.size() < size) failAtEnd(*source_);
  const char* const bytes = rest_.data();
  rest_.remove_prefix(size);
  const bool swap = (format_ == PlyFormat::kBigEndian) != (std::endian::native == std::endian::big);
  switch (type) {
    case PlyType::kInt8:
      return valueOf<std::int8_t>(bytes, swap);
    case PlyType::kUint8:
      return valueOf<std::uint8_t>(bytes, swap);
    case PlyType::kInt16:
      return valueOf<std::int16_t>(bytes, swap);
    case PlyType::kUint16:
      return valueOf<std::uint16_t>(bytes, swap);
    case PlyType::kInt32:
      return valueOf<std::int32_t>(bytes, swap);
    case PlyType::kUint32:
      return valueOf<std::uint32_t>(bytes, swap);
    case PlyType::kFloat:
      return valueOf<float>(bytes, swap);
    default:
      return valueOf<double>(bytes, swap);
  }
}

}  // namespace glintmark
