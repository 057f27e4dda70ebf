#include "host/scene/import/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace glintmark {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

std::optional<double> plainNumber(std::string_view word) {
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end) return std::nullopt;
  if (error == std::errc()) return value;
  if (error != std::errc::result_out_of_range) return std::nullopt;
  const std::size_t exponent = word.find_first_of("eE");
  const bool tiny = exponent != std::string_view::npos
                        ? word.substr(exponent + 1).starts_with('-')
                        : word.find_first_of("123456789") > word.find('.');
  if (tiny) return 0;
  return word.starts_with('-') ? -kInfinity : kInfinity;
}

void appendUtf8(std::string& out, char32_t c) {
  if (c < 0x80) {
    out += static_cast<char>(c);
    return;
  }
  const int more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
  constexpr unsigned char kLead[] = {0, 0xC0, 0xE0, 0xF0};
  out += static_cast<char>(kLead[more] | c >> (6 * more));
  for (int i = more - 1; i >= 0; --i) out += static_cast<char>(0x80 | (c >> (6 * i) & 0x3F));
}

std::string fromUtf16(std::string_view bytes, bool big_endian) {
  std::string out;
  out.reserve(bytes.size() / 2);
  const auto unit = [&](std::size_t at) {
    const auto a = static_cast<unsigned char>(bytes[at]);
    const auto b = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<char32_t>(big_endian ? a << 8 | b : b << 8 | a);
  };
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    char32_t c = unit(at);
    if (c >= 0xD800 && c < 0xDC00 && at + 3 < bytes.size()) {
      const char32_t low = unit(at + 2);
      if (low >= 0xDC00 && low < 0xE000) {
        c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
        at += 2;
      }
    }
    appendUtf8(out, c >= 0xD800 && c < 0xE000 ? 0xFFFD : c);
  }
  return out;
}

}  // namespace

std::optional<double> parseNumber(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.starts_with('+')) return std::nullopt;
  if (const auto value = plainNumber(word)) return value;
  if (const std::size_t windows = word.find("#"); windows != std::string_view::npos) {
    if (word.substr(windows).starts_with("#INF")) return word[0] == '-' ? -kInfinity : kInfinity;
    return kNan;
  }
  // Other spellings of the same numbers.
  std::string copy(word.substr(0, std::min<std::size_t>(word.size(), 1000)));
  for (char& c : copy) {
    if (c == 'd' || c == 'D') c = 'e';
    if (c == ',') c = '.';
  }
  const std::size_t exponent_sign = copy.find_first_of("eE");
  if (exponent_sign != std::string::npos && copy.size() > exponent_sign + 1 &&
      copy[exponent_sign + 1] == '+')
    copy.erase(exponent_sign + 1, 1);
  return plainNumber(copy);
}

std::string_view takeWord(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && isBlank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !isBlank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  ++number_;
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (rest_.starts_with("\r\n")) rest_.remove_prefix(1);
  if (!rest_.empty()) rest_.remove_prefix(1);
  return true;
}

std::string toUtf8(std::string bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  if (bytes.starts_with("\xFF\xFE")) return fromUtf16(std::string_view(bytes).substr(2), false);
  if (bytes.starts_with("\xFE\xFF")) return fromUtf16(std::string_view(bytes).substr(2), true);
  return bytes;
}

}  // namespace glintmark
