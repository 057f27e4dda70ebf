// How deeply a TOML text nests, found before its parser works on it.
#pragma once
#include <string>
#include <string_view>

namespace glintmark {

/// Steps of a dotted key, and brackets in brackets, that a scene may have: parsers take a bit of
/// the stack for each.
inline constexpr int kMostTomlDepth = 64;

/// Throws Error naming `source` and the line of a key with more steps, or of more open brackets,
/// than kMostTomlDepth.
void checkTomlDepth(std::string_view text, const std::string& source);

}  // namespace glintmark
