// Text as it may stand in XML.
#pragma once
#include <string>
#include <string_view>

namespace glintmark {

/// `text` with '&', '<' and '"' as entities: for content, and for attributes in double quotes.
inline std::string escapedXml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace glintmark
