// What may include what.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "tests/house/house.h"

namespace glintmark::house {
namespace {

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Why a file of `from` may not include the project's file `to`; empty if it may.
std::string wallBetween(const std::string& from, const std::string& to, const Order& order) {
  const std::string area = partOf(from, 0), other = partOf(to, 0);
  if (area == "kernels") return other == "kernels" ? "" : "kernels include nothing but kernels";
  if (other == "kernels" || (area == other && area != "host")) return "";
  if (other != "host") {
    const bool lends =
        (area == "tests" && other == "fuzz") || (area == "bench" && other == "tests");
    return lends ? "" : area + " includes nothing of " + other;
  }
  if (area != "host" || from == "host/main.cpp") return "";
  const std::string folder = partOf(from, 1), wanted = partOf(to, 1);
  if (folder == wanted) return "";
  const int floor = order.floorOf(folder), wanted_floor = order.floorOf(wanted);
  if (floor < 0) return "host/order.txt does not know host/" + folder;
  if (wanted_floor < 0) return "host/order.txt does not know host/" + wanted;
  if (wanted_floor < floor) return "";
  return "host/" + wanted + (wanted_floor == floor ? " stands beside host/" : " is above host/") +
         folder;
}

std::string outOfItsHome(const std::string& from, const std::string& name, const Order& order) {
  for (const auto& [start, homes] : order.only) {
    if (!name.starts_with(start)) continue;
    const bool at_home =
        std::ranges::any_of(homes, [&](const std::string& home) { return from.starts_with(home); });
    if (!at_home) return start + " is for " + homes.front() + " only";
  }
  return "";
}

}  // namespace

int Order::floorOf(const std::string& folder) const {
  for (std::size_t i = 0; i < floors.size(); ++i)
    if (std::ranges::find(floors[i], folder) != floors[i].end()) return static_cast<int>(i);
  return -1;
}

Order parseOrder(const std::string& text) {
  Order order;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> words = wordsOf(line);
    if (words.empty() || words[0].starts_with('#')) continue;
    const std::string key = words[0];
    words.erase(words.begin());
    if (key == "order" && !words.empty()) {
      order.floors.push_back(words);
    } else if (key == "only" && words.size() > 1) {
      order.only.emplace_back(words[0], std::vector(words.begin() + 1, words.end()));
    } else if (key == "generated" && !words.empty()) {
      order.generated.insert(words.begin(), words.end());
    } else {
      throw std::runtime_error("host/order.txt: not understood: " + line);
    }
  }
  return order;
}

std::vector<Include> includesOf(const std::string& text) {
  std::vector<Include> includes;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    at = line.find_first_not_of(" \t", at + 7);
    if (at == std::string::npos || (line[at] != '"' && line[at] != '<')) continue;  // a macro
    const bool quoted = line[at] == '"';
    const std::size_t end = line.find(quoted ? '"' : '>', at + 1);
    if (end != std::string::npos)
      includes.push_back({line.substr(at + 1, end - at - 1), number, quoted});
  }
  return includes;
}

bool isSource(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".h" || extension == ".cpp" || extension == ".cl" || extension == ".clh";
}

std::string folderOf(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

std::string partOf(const std::string& path, int index) {
  std::istringstream parts(path);
  std::string part;
  for (int i = 0; i <= index; ++i)
    if (!std::getline(parts, part, '/')) return "";
  return part;
}

std::string resolve(const std::string& from, const Include& include, const Files& files) {
  if (files.contains(include.name)) return include.name;
  if (!include.quoted || partOf(from, 0) != "kernels") return "";
  for (const std::string& folder : {folderOf(from), std::string("kernels")}) {
    auto path = (std::filesystem::path(folder) / include.name).lexically_normal().string();
    if (files.contains(path)) return path;
  }
  return "";
}

std::vector<std::string> includeFaults(const Files& files, const Order& order) {
  std::vector<std::string> faults;
  for (const auto& [path, text] : files) {
    if (!isSource(path)) continue;
    for (const Include& include : includesOf(text)) {
      const std::string target = resolve(path, include, files);
      std::string fault = outOfItsHome(path, include.name, order);
      if (fault.empty() && !target.empty()) fault = wallBetween(path, target, order);
      if (fault.empty() && target.empty() && include.quoted &&
          !order.generated.contains(include.name))
        fault = "there is no such file below the project's root";
      if (!fault.empty())
        faults.push_back(
            fmt::format("{}:{}: includes {}: {}", path, include.line, include.name, fault));
    }
  }
  return faults;
}

}  // namespace glintmark::house
