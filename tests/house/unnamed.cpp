// What is unnamed: names that one source alone sees, unless it is compiled together with others.
#include <algorithm>
#include <regex>

#include "tests/house/house.h"

namespace glintmark::house {
namespace {

// Without comments and with empty strings.
std::string codeOf(const std::string& text) {
  static const std::regex noise(R"(//[^\n]*|"(\\.|[^"\\\n])*")");
  return std::regex_replace(text, noise, "");
}

// The lines between "namespace {" and the "}" that closes it, where nothing is indented.
std::vector<std::string> unnamedLines(const std::string& code) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  bool inside = false;
  int depth = 0;
  for (std::size_t end; begin < code.size(); begin = end + 1) {
    end = std::min(code.find('\n', begin), code.size());
    const std::string line = code.substr(begin, end - begin);
    if (line == "namespace {") {
      inside = true;
      depth = 0;
    } else if (inside) {
      if (depth == 0) lines.push_back(line);
      for (const char c : line) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
      if (depth < 0) inside = false;
    }
  }
  return lines;
}

// What a line at the outermost level declares, with the types of a function's parameters as far as
// they stand on the line, since functions may share a name; "" if nothing.
std::string declaredBy(const std::string& line) {
  static const std::regex type(R"(^(?:struct|class|enum class|enum)\s+(\w+)\b.*)");
  static const std::regex function(R"(^[\w:][\w:<>,&*\s]*[\s&*](\w+\(.*)$)");
  static const std::regex variable(
      R"(^(?:constexpr|const|static|inline)\b[^=({]*[\s&*](\w+)(?:\[[^\]]*\])*\s*[={;].*)");
  std::smatch match;
  for (const std::regex* kind : {&type, &variable, &function})
    if (std::regex_match(line, match, *kind)) return match[1];
  return "";
}

}  // namespace

std::vector<std::string> sharedUnnamed(const Files& files) {
  std::map<std::string, std::map<std::string, std::string>> first;  // of a folder: file by name
  std::vector<std::string> faults;
  for (const auto& [path, text] : files) {
    if (!path.ends_with(".cpp") || path.starts_with("bench/")) continue;
    for (const std::string& line : unnamedLines(codeOf(text))) {
      const std::string name = declaredBy(line);
      if (name.empty()) continue;
      const auto [known, is_new] = first[folderOf(path)].emplace(name, path);
      if (!is_new && known->second != path)
        faults.push_back(path + ": '" + name.substr(0, name.find('(')) + "' is also a name of " +
                         known->second);
    }
  }
  return faults;
}

}  // namespace glintmark::house
