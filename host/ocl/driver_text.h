// Text that drivers give, as it can be shown.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace glintmark {

/// In one line of at most `most_bytes`, then "...": without the blanks around it and all from its
/// NUL on; "?" for every control character and every byte that is no UTF-8.
std::string shownText(std::string_view text, std::size_t most_bytes = 200);

}  // namespace glintmark
