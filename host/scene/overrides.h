// `--set path.to.key=value`: changes a scene's TOML before it is read.
#pragma once
#include <toml++/toml.h>

#include <string>

namespace glintmark {

/// Applies one override to the file's root table. A path step is a key of a table, or, in an array,
/// an element's `name` or its position from 0. The value is read as TOML, or else as a string. A
/// table that is missing on the way, and the last key, are created: whether they mean anything is
/// for the reader to say. Throws Error for text without '=', an empty step, an array element that
/// does not exist (listing those that do) and a step into a plain value.
void applyOverride(toml::table& root, const std::string& override_text, const std::string& file);

}  // namespace glintmark
