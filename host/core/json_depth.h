// How deeply a JSON text nests, found before its parser works on it.
#pragma once
#include <string>
#include <string_view>

namespace glintmark {

/// Brackets in brackets that a JSON file may have: what is read of it is copied, compared and
/// printed by functions that call themselves for each.
inline constexpr int kMostJsonDepth = 256;

/// Throws Error naming `source` for a text of more open brackets than kMostJsonDepth.
void checkJsonDepth(std::string_view text, const std::string& source);

}  // namespace glintmark
