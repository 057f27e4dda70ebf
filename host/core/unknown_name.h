// What is said wherever a user names something that there is not.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace glintmark {

/// "a, b and c".
std::string listOf(std::span<const std::string> items, std::string_view last_word);

/// "unknown method 'zk61'; methods are zk16, exact, distributed; did you mean zk16?", the last
/// only where a known name is near. `kinds`: the plural, where an s is not enough.
std::string unknownName(const std::string& kind, const std::string& name,
                        std::span<const std::string> known, const std::string& kinds = "");

/// Throws Error of unknownName() if `name` is not among `known`.
void requireKnownName(const std::string& kind, const std::string& name,
                      std::span<const std::string> known, const std::string& kinds = "");

}  // namespace glintmark
