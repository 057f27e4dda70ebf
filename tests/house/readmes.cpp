// What a folder says of itself.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "tests/house/house.h"

namespace glintmark::house {
namespace {

constexpr int kMostLines = 10;

// What stands between backquotes.
std::vector<std::string> quotedIn(const std::string& text) {
  std::vector<std::string> names;
  static const std::regex quoted_name("`([^`]+)`");
  for (std::sregex_iterator it(text.begin(), text.end(), quoted_name), end; it != end; ++it)
    names.push_back((*it)[1]);
  return names;
}

// From `start` to the end of its sentence; empty if there is none.
std::string sentence(const std::string& text, const std::string& start) {
  const std::size_t at = text.find(start);
  if (at == std::string::npos) return "";
  static const std::regex full_stop(R"(\.\s|\.$)");
  std::smatch end;
  const std::string rest = text.substr(at);
  return std::regex_search(rest, end, full_stop) ? rest.substr(0, end.position(0)) : rest;
}

// Names of one place: folders end in '/', files have an extension that the project uses.
bool isPath(const std::string& name) {
  static const std::regex path_name(R"([\w./+-]+(/|\.(h|cpp|cl|clh|txt|md|toml|css|js|cmake)))");
  return std::regex_match(name, path_name);
}

bool exists(const std::string& folder, const std::string& name, const Files& files) {
  for (std::filesystem::path from = folder;; from = from.parent_path()) {
    const std::string path = (from / name).lexically_normal().string();
    const auto found = files.lower_bound(path);
    if (found != files.end() &&
        (name.ends_with('/') ? found->first.starts_with(path) : found->first == path))
      return true;
    if (from.empty()) return false;
  }
}

// But for itself and what it holds.
std::set<std::string> foldersIncludedBy(const std::string& folder, const Files& files) {
  std::set<std::string> included;
  for (const auto& [path, text] : files) {
    if (!isSource(path) || folderOf(path) != folder) continue;
    for (const Include& include : includesOf(text)) {
      const std::string target = resolve(path, include, files);
      if (!target.empty() && !target.starts_with(folder + "/")) included.insert(folderOf(target));
    }
  }
  return included;
}

// "host/report/record" is covered by "report/record/" and by "report/"; "kernels/area" by
// "kernels/".
bool covers(const std::string& named, const std::string& folder) {
  const std::string whole = folder + "/";
  return whole.starts_with(named) || whole.starts_with("host/" + named);
}

void addIncludeFaults(std::vector<std::string>& faults, const std::string& folder,
                      const std::string& text, const Files& files, const Order& order) {
  const std::string readme = folder + "/README.md: ", own = partOf(folder, 1);
  const std::string may = sentence(text, "May include");
  if (may.empty()) {
    faults.push_back(readme + "does not say what the folder may include (\"May include ….\")");
    return;
  }
  const std::vector<std::string> named = quotedIn(may);
  for (const std::string& included : foldersIncludedBy(folder, files))
    if (std::ranges::none_of(named, [&](const std::string& n) { return covers(n, included); }))
      faults.push_back(fmt::format("{}\"May include\" does not name {}, which the folder includes",
                                   readme, included));
  for (const std::string& name : named) {
    const std::string top = partOf(name, 0);
    if (top == "kernels" || top == own) continue;
    const int floor = order.floorOf(top);
    if (floor < 0 || floor >= order.floorOf(own))
      faults.push_back(fmt::format(
          "{}\"May include\" names {}, which host/order.txt does not allow", readme, name));
  }
}

void addHostFaults(std::vector<std::string>& faults, const std::string& folder,
                   const std::string& text, const Files& files, const Order& order,
                   const std::set<std::string>& programs) {
  addIncludeFaults(faults, folder, text, files, order);
  const std::string after = sentence(text, "After a change");
  if (after.empty())
    faults.push_back(folder + "/README.md: does not say what to run (\"After a change: ….\")");
  for (const std::string& name : quotedIn(after))
    if (!programs.contains(name) && !name.starts_with("glintmark "))
      faults.push_back(
          fmt::format("{}/README.md: \"After a change\" names {}, which no CMakeLists.txt defines",
                      folder, name));
}

}  // namespace

std::set<std::string> definedPrograms(const Files& files) {
  std::set<std::string> programs;
  static const std::regex definition(R"(glintmark_(?:test|bench)\((\w+))");
  for (const auto& [path, text] : files) {
    if (!path.ends_with("CMakeLists.txt")) continue;
    for (std::sregex_iterator it(text.begin(), text.end(), definition), end; it != end; ++it)
      programs.insert((*it)[1]);
  }
  return programs;
}

std::vector<std::string> readmeFaults(const Files& files, const Order& order,
                                      const std::set<std::string>& programs) {
  std::set<std::string> folders;
  for (const auto& [path, text] : files)
    if (isSource(path) && (path.starts_with("host/") || path.starts_with("kernels/")))
      folders.insert(folderOf(path));
  folders.erase("host");
  folders.erase("kernels");  // its README.md is the kernels' manual
  std::vector<std::string> faults;
  for (const std::string& folder : folders) {
    const std::string path = folder + "/README.md";
    const auto readme = files.find(path);
    if (readme == files.end()) {
      faults.push_back(folder + " has no README.md");
      continue;
    }
    const std::string& text = readme->second;
    if (std::ranges::count(text, '\n') > kMostLines)
      faults.push_back(fmt::format("{}: more than {} lines", path, kMostLines));
    const std::string name = std::filesystem::path(folder).filename().string();
    if (!text.starts_with("# " + name + ":"))
      faults.push_back(fmt::format("{}: does not begin with \"# {}: \"", path, name));
    for (const std::string& quoted : quotedIn(text))
      if (isPath(quoted) && !exists(folder, quoted, files))
        faults.push_back(fmt::format("{}: there is no {}", path, quoted));
    if (folder.starts_with("host/")) addHostFaults(faults, folder, text, files, order, programs);
  }
  return faults;
}

}  // namespace glintmark::house
