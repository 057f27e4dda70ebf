#include "tests/faulty_driver/fault_list.h"

#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

namespace faulty {
namespace {

std::multimap<std::string, std::string> readList() {
  const char* text = std::getenv("GLINTMARK_FAULTS");
  std::istringstream words(text ? text : "");
  std::multimap<std::string, std::string> list;
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    list.emplace(word.substr(0, equals), equals == word.npos ? "" : word.substr(equals + 1));
  }
  return list;
}

const std::multimap<std::string, std::string>& faults() {
  static const std::multimap<std::string, std::string> list = readList();
  return list;
}

}  // namespace

bool asked(const std::string& name, const std::string& value) {
  const auto [begin, end] = faults().equal_range(name);
  for (auto it = begin; it != end; ++it)
    if (it->second == value) return true;
  return false;
}

std::optional<std::string> valueOf(const std::string& name) {
  const auto it = faults().find(name);
  return it == faults().end() ? std::nullopt : std::optional(it->second);
}

std::optional<std::string> valueOfPart(const std::string& name, const std::string& part) {
  const auto [begin, end] = faults().equal_range(name);
  for (auto it = begin; it != end; ++it)
    if (it->second.starts_with(part + ":")) return it->second.substr(part.size() + 1);
  return std::nullopt;
}

unsigned long long numberOf(const std::string& name) {
  const auto value = valueOf(name);
  return value ? std::strtoull(value->c_str(), nullptr, 10) : 0;
}

}  // namespace faulty
