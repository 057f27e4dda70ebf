// Circles of includes.
#include <algorithm>
#include <filesystem>
#include <queue>

#include "tests/house/house.h"

namespace glintmark::house {
namespace {

using Graph = std::map<std::string, std::set<std::string>>;

// The shortest way in arrows; empty if there is none.
std::string way(const Graph& graph, const std::string& from, const std::string& to) {
  std::map<std::string, std::string> before = {{from, ""}};
  std::queue<std::string> open({from});
  for (; !open.empty() && !before.contains(to); open.pop()) {
    const auto edges = graph.find(open.front());
    if (edges == graph.end()) continue;
    for (const std::string& next : edges->second)
      if (before.emplace(next, open.front()).second) open.push(next);
  }
  if (!before.contains(to)) return "";
  std::string text = to;
  for (std::string at = before[to]; !at.empty(); at = before[at]) text.insert(0, at + " -> ");
  return text;
}

// The shortest circle with an edge of `edges` of all that hang together.
void addCircles(std::vector<std::string>& found, const Graph& graph, const Graph& edges) {
  std::vector<std::pair<std::string, std::string>> all;  // a node and a circle from it
  for (const auto& [from, targets] : edges)
    for (const std::string& to : targets) {
      std::string back = way(graph, to, from);
      if (!back.empty()) all.emplace_back(from, back.insert(0, from + " -> "));
    }
  const auto arrows = [](const auto& circle) { return std::ranges::count(circle.second, '>'); };
  std::ranges::stable_sort(all, {}, arrows);
  std::vector<std::string> shown;
  for (const auto& circle : all) {
    const std::string& node = circle.first;
    const bool hangs_together = std::ranges::any_of(shown, [&](const std::string& other) {
      return !way(graph, node, other).empty() && !way(graph, other, node).empty();
    });
    if (hangs_together) continue;
    shown.push_back(node);
    found.push_back(circle.second);
  }
}

std::string moduleOf(const std::string& path) {
  return std::filesystem::path(path).replace_extension().string();
}

bool holds(const std::string& folder, const std::string& other) {
  return other.starts_with(folder + "/");
}

}  // namespace

std::vector<std::string> circles(const Files& files) {
  Graph modules, between_folders, folders;
  for (const auto& [path, text] : files) {
    if (!isSource(path)) continue;
    for (const Include& include : includesOf(text)) {
      const std::string target = resolve(path, include, files);
      if (target.empty() || moduleOf(path) == moduleOf(target)) continue;
      modules[moduleOf(path)].insert(moduleOf(target));
      const std::string from = folderOf(path), to = folderOf(target);
      if (from == to) continue;
      between_folders[moduleOf(path)].insert(moduleOf(target));
      if (!holds(from, to) && !holds(to, from)) folders[from].insert(to);
    }
  }
  std::vector<std::string> found;
  addCircles(found, modules, between_folders);
  addCircles(found, folders, folders);
  return found;
}

}  // namespace glintmark::house
