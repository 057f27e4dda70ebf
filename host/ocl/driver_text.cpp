#include "host/ocl/driver_text.h"

#include <algorithm>

namespace glintmark {
namespace {

bool isBlank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// Bytes of the character that `text` begins with, by the table of well-formed UTF-8 (Unicode 15,
// Table 3-7); 0 if there is none, or it is a control character.
std::size_t characterBytes(std::string_view text) {
  const auto at = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto follows = [&](std::size_t i) { return (at(i) & 0xC0u) == 0x80u; };
  const unsigned lead = at(0), next = at(1);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  if (lead >= 0xC2 && lead <= 0xDF) return follows(1) && (lead != 0xC2 || next >= 0xA0) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF)
    return follows(1) && follows(2) && (lead != 0xE0 || next >= 0xA0) &&
                   (lead != 0xED || next < 0xA0)
               ? 3
               : 0;
  if (lead >= 0xF0 && lead <= 0xF4)
    return follows(1) && follows(2) && follows(3) && (lead != 0xF0 || next >= 0x90) &&
                   (lead != 0xF4 || next < 0x90)
               ? 4
               : 0;
  return 0;
}

}  // namespace

std::string shownText(std::string_view text, std::size_t most_bytes) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  text = text.substr(0, text.find('\0'));
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  std::string shown;
  while (!text.empty()) {
    const std::size_t bytes = characterBytes(text);
    if (shown.size() + std::max<std::size_t>(bytes, 1) > most_bytes) return shown + "...";
    if (bytes == 0)
      shown += isBlank(text.front()) ? ' ' : '?';
    else
      shown += text.substr(0, bytes);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown;
}

}  // namespace glintmark
