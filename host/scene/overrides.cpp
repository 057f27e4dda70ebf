#include "host/scene/overrides.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "host/core/error.h"
#include "host/scene/toml_depth.h"

namespace glintmark {
namespace {

std::vector<std::string> splitPath(const std::string& path, const std::string& source) {
  std::vector<std::string> steps;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    steps.push_back(path.substr(begin, end - begin));
    if (steps.back().empty()) {
      throw Error(fmt::format("{}: the path has an empty step, expected key.key=value", source));
    }
    if (end == path.size()) return steps;
    if (steps.size() > kMostTomlDepth)
      throw Error(
          fmt::format("{}: the path has more than {} steps", source.substr(0, 80), kMostTomlDepth));
    begin = end + 1;
  }
}

/// A table with the one key `value`, which carries `source` as its place of origin.
toml::table parseValue(const std::string& text, const std::string& source) {
  checkTomlDepth(text, source);
  try {
    toml::table parsed = toml::parse("value = " + text, source);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    // Not TOML: a bare word is a string.
  }
  std::string quoted;
  for (const char c : text) {
    const bool plain = static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\' && c != 0x7F;
    quoted += plain ? std::string(1, c) : fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
  }
  try {
    return toml::parse("value = \"" + quoted + "\"", source);
  } catch (const toml::parse_error&) {
    throw Error(fmt::format("{}: the value is not UTF-8 text", source));
  }
}

/// The element of `array` that `step` names, by `name` or by position.
toml::node& findElement(toml::array& array, const std::string& step, const std::string& where,
                        const std::string& source) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < array.size(); ++i) {
    toml::node& element = *array.get(i);
    const toml::table* table = element.as_table();
    const auto name = table != nullptr ? (*table)["name"].value<std::string>() : std::nullopt;
    if (name == step) return element;
    known.push_back(name ? *name : std::to_string(i));
  }
  std::size_t position = 0;
  const char* const end = step.data() + step.size();
  const auto [stop, error] = std::from_chars(step.data(), end, position);
  if (error == std::errc() && stop == end && position < array.size()) return *array.get(position);
  throw Error(fmt::format("{}: {} has no element {}, known are {}", source, where, step,
                          fmt::join(known, ", ")));
}

/// The node one step below `node`; a table that lacks it gets an empty table there.
toml::node& descend(toml::node& node, const std::string& step, const std::string& where,
                    const std::string& source) {
  if (toml::array* array = node.as_array()) return findElement(*array, step, where, source);
  toml::table* table = node.as_table();
  if (table == nullptr) {
    throw Error(fmt::format("{}: {} is a plain value and has no key {}", source, where, step));
  }
  if (!table->contains(step)) table->insert(step, toml::table{});
  return *table->get(step);
}

}  // namespace

void applyOverride(toml::table& root, const std::string& override_text, const std::string& file) {
  const std::string source = "--set " + override_text;
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(fmt::format("{}: expected key.key=value, a path into {}", source, file));
  }
  const std::vector<std::string> steps = splitPath(override_text.substr(0, equals), source);
  toml::table parsed = parseValue(override_text.substr(equals + 1), source);
  toml::node& value = *parsed.get("value");

  toml::node* node = &root;
  std::string where = "the scene";
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    node = &descend(*node, steps[i], where, source);
    if (i == 0)
      where = steps[i];
    else
      where.append(".").append(steps[i]);
  }
  const std::string& last = steps.back();
  if (toml::array* array = node->as_array()) {
    const toml::node* element = &findElement(*array, last, where, source);
    const auto position =
        std::find_if(array->begin(), array->end(), [&](const auto& e) { return &e == element; });
    value.visit([&](auto& v) { array->replace(position, std::move(v)); });
  } else if (toml::table* table = node->as_table()) {
    value.visit([&](auto& v) { table->insert_or_assign(last, std::move(v)); });
  } else {
    throw Error(fmt::format("{}: {} is a plain value and has no key {}", source, where, last));
  }
}

}  // namespace glintmark
