// What every page begins and ends with: style, scripts.
#pragma once
#include <string>

namespace glintmark {

/// Everything of a page before what its body holds; `title` is plain text.
std::string pageHead(const std::string& title);

/// Everything behind its main part, which it closes. `records` is the JSON that the page's script
/// reads, without "<".
std::string pageEnd(const std::string& records);

}  // namespace glintmark
