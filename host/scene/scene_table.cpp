#include "host/scene/scene_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "host/core/error.h"

namespace glintmark {
namespace {

/// A node as messages show it.
std::string describe(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "an array";
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  std::ostringstream out;
  node.visit([&out](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) out << value;
  });
  return out.str();
}

}  // namespace

std::string Range::text() const {
  const bool no_low = low == -kLargestNumber;
  const bool no_high = high == kLargestNumber;
  if (no_low && no_high) return "a finite number";
  if (no_high) return fmt::format("a number {} {}", open_low ? "above" : "of at least", low);
  return fmt::format("a number in {}{}, {}]", open_low ? '(' : '[', low, high);
}

std::string locate(const toml::node& node, const std::string& file) {
  const toml::source_region& source = node.source();
  if (!source.path || !source.begin) return file + ": ";
  if (source.path->starts_with("--set")) return *source.path + ": ";
  return fmt::format("{}:{}: ", *source.path, source.begin.line);
}

SceneTable::SceneTable(const toml::table& table, std::string path, std::string file)
    : table_(&table), path_(std::move(path)), file_(std::move(file)) {}

const toml::node* SceneTable::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return table_->get(key);
}

std::string SceneTable::pathOf(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void SceneTable::fail(std::string_view key, const std::string& complaint) const {
  const toml::node* node = table_->get(key);
  const std::string where = locate(node != nullptr ? *node : *table_, file_);
  throw Error(where + pathOf(key) + " " + complaint);
}

bool SceneTable::has(std::string_view key) {
  return find(key) != nullptr;
}

bool SceneTable::isText(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_string();
}

double SceneTable::checkedNumber(std::string_view key, const toml::node& node,
                                 const Range& range) const {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (value && std::isfinite(*value) && std::abs(*value) > kLargestNumber)
    fail(key, fmt::format("is {}, beyond the range of single precision, 3.4e38", describe(node)));
  if (value && range.open_low && *value > 0 && *value < std::numeric_limits<float>::min())
    fail(key, fmt::format("is {}, below the range of single precision, 1.2e-38", describe(node)));
  if (!value || !range.contains(*value)) {
    fail(key, fmt::format("is {}, expected {}", describe(node), range.text()));
  }
  return *value;
}

double SceneTable::number(std::string_view key, double fallback, const Range& range) {
  const toml::node* node = find(key);
  return node != nullptr ? checkedNumber(key, *node, range) : fallback;
}

int SceneTable::integer(std::string_view key, int fallback, int low, int high) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const std::optional<std::int64_t> value = node->value_exact<std::int64_t>();
  if (!value || *value < low || *value > high) {
    fail(key,
         fmt::format("is {}, expected a whole number in [{}, {}]", describe(*node), low, high));
  }
  return static_cast<int>(*value);
}

bool SceneTable::flag(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) {
    fail(key, fmt::format("is {}, expected true or false", describe(*node)));
  }
  return *node->value<bool>();
}

std::string SceneTable::text(std::string_view key, const std::string& fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_string()) fail(key, fmt::format("is {}, expected a string", describe(*node)));
  return *node->value<std::string>();
}

template <int kCount>
glm::vec<kCount, double> SceneTable::vector(std::string_view key, const toml::node& node,
                                            const Range& range) const {
  if (node.is_number()) return glm::vec<kCount, double>(checkedNumber(key, node, range));
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != kCount) {
    fail(key, fmt::format("is {}, expected {} numbers or one number", describe(node), kCount));
  }
  glm::vec<kCount, double> result;
  for (int i = 0; i < kCount; ++i) {
    result[i] = checkedNumber(key, *array->get(static_cast<std::size_t>(i)), range);
  }
  return result;
}

glm::dvec3 SceneTable::vector3(std::string_view key, const glm::dvec3& fallback,
                               const Range& range) {
  const toml::node* node = find(key);
  return node != nullptr ? vector<3>(key, *node, range) : fallback;
}

glm::dvec2 SceneTable::vector2(std::string_view key, const glm::dvec2& fallback,
                               const Range& range) {
  const toml::node* node = find(key);
  return node != nullptr ? vector<2>(key, *node, range) : fallback;
}

std::vector<glm::dvec3> SceneTable::colours(std::string_view key, const Range& range) {
  std::vector<glm::dvec3> result;
  const toml::node* node = find(key);
  if (node == nullptr) return result;
  const toml::array* array = node->as_array();
  if (array == nullptr)
    fail(key, fmt::format("is {}, expected a list of colours", describe(*node)));
  for (const toml::node& colour : *array) result.push_back(vector<3>(key, colour, range));
  return result;
}

std::optional<SceneTable> SceneTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::table* inner = node->as_table();
  if (inner == nullptr) fail(key, fmt::format("is {}, expected a table", describe(*node)));
  return SceneTable(*inner, pathOf(key), file_);
}

std::vector<SceneTable> SceneTable::tables(std::string_view key) {
  std::vector<SceneTable> result;
  const toml::node* node = find(key);
  if (node == nullptr) return result;
  const toml::array* array = node->as_array();
  if (array == nullptr) {
    fail(key, fmt::format("is {}, expected tables headed [[{}]]", describe(*node), pathOf(key)));
  }
  for (const toml::node& element : *array) {
    const toml::table* inner = element.as_table();
    if (inner == nullptr) fail(key, fmt::format("holds {}, expected tables", describe(element)));
    const auto name = (*inner)["name"].value<std::string>();
    const std::string label = name ? *name : std::to_string(result.size());
    result.emplace_back(*inner, pathOf(key) + "." + label, file_);
  }
  return result;
}

std::vector<std::pair<std::string, std::string>> SceneTable::textEntries() {
  std::vector<std::pair<std::string, std::string>> result;
  for (const auto& [key, node] : *table_) result.emplace_back(key.str(), text(key.str()));
  return result;
}

void SceneTable::finish() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    std::vector<std::string> known = known_;
    std::sort(known.begin(), known.end());
    fail(key.str(), fmt::format("is an unknown key, known here are {}", fmt::join(known, ", ")));
  }
}

}  // namespace glintmark
