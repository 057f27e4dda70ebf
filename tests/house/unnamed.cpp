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
// they stand on the line, since functions may share a name. A line may declare several constants.
std::vector<std::string> declaredBy(const std::string& line) {
  static const std::regex type(R"(^(?:struct|class|enum class|enum)\s+(\w+)\b.*)");
  static const std::regex alias(R"(^using\s+(\w+)\s*=.*)");
  static const std::regex function(R"(^[\w:][\w:<>,&*\s]*[\s&*](\w+\(.*)$)");
  static const std::regex variable(
      R"(^(?:constexpr|const|static|inline)\b[^=({]*[\s&*](\w+)(?:\[[^\]]*\])*\s*[={;].*)");
  static const std::regex next_constant(R"(,\s*[&*]*(k[A-Z]\w*)\s*=)");
  std::smatch match;
  for (const std::regex* kind : {&type, &alias, &variable, &function}) {
    if (!std::regex_match(line, match, *kind)) continue;
    std::vector<std::string> names = {match[1]};
    if (kind == &variable)
      for (std::sregex_iterator it(line.begin(), line.end(), next_constant), end; it != end; ++it)
        names.push_back((*it)[1]);
    return names;
  }
  return {};
}

}  // namespace

std::vector<std::string> sharedUnnamed(const Files& files) {
  // Of a folder, by name: the file, and the line, since a type may be called the same twice.
  std::map<std::string, std::map<std::string, std::pair<std::string, std::string>>> first;
  std::vector<std::string> faults;
  for (const auto& [path, text] : files) {
    if (!path.ends_with(".cpp") || path.starts_with("bench/")) continue;
    for (const std::string& line : unnamedLines(codeOf(text)))
      for (const std::string& name : declaredBy(line)) {
        const auto [known, is_new] = first[folderOf(path)].try_emplace(name, path, line);
        const auto& [other, other_line] = known->second;
        if (!is_new && other != path && !(line.starts_with("using ") && line == other_line))
          faults.push_back(path + ": '" + name.substr(0, name.find('(')) + "' is also a name of " +
                           other);
      }
  }
  return faults;
}

}  // namespace glintmark::house
