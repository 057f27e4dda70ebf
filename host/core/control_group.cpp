#include "host/core/control_group.h"

#include <fstream>
#include <sstream>

namespace glintmark {

namespace fs = std::filesystem;

std::optional<double> readNumber(const fs::path& file) {
  std::ifstream stream(file);
  double value = 0;
  return stream >> value ? std::optional(value) : std::nullopt;
}

std::optional<double> numberAfter(const fs::path& file, const std::string& word) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string first;
    double value = 0;
    if (words >> first >> value && first == word) return value;
  }
  return std::nullopt;
}

std::vector<fs::path> groupFolders(const fs::path& root, const std::string& controller) {
  std::ifstream stream(root / "proc/self/cgroup");
  std::vector<fs::path> folders;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    std::string names(1, ',');
    names.append(line, first + 1, second - first - 1).push_back(',');
    const bool matches =
        controller.empty() ? names == ",," : names.find("," + controller + ",") != names.npos;
    if (!matches) continue;
    const fs::path mount = root / "sys/fs/cgroup" / controller;
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path();;
         group = group.parent_path()) {
      folders.push_back(mount / group);
      if (group.empty()) break;
    }
  }
  return folders;
}

}  // namespace glintmark
