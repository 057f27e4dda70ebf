#include "host/core/json_depth.h"

#include <fmt/format.h>

#include "host/core/error.h"

namespace glintmark {

void checkJsonDepth(std::string_view text, const std::string& source) {
  int open = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      // To its end; a text that is cut off has none.
      while (++at < text.size() && text[at] != '"') at += text[at] == '\\';
    } else if (c == '[' || c == '{') {
      if (++open > kMostJsonDepth)
        throw Error(fmt::format("{}: has more brackets in brackets than the {} that are read",
                                source, kMostJsonDepth));
    } else if ((c == ']' || c == '}') && open > 0) {
      --open;
    }
  }
}

}  // namespace glintmark
