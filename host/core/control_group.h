// Limits that the system's files say: /proc and control groups of both versions.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glintmark {

/// Folders of this process's control group and its parents for a controller ("cpu", "memory"); ""
/// is version 2, which has one for all. In a container the group's own path may not be there, but
/// the root is the container's then. `root` stands for "/".
std::vector<std::filesystem::path> groupFolders(const std::filesystem::path& root,
                                                const std::string& controller);

/// The number that a file begins with; nothing if it is missing or begins otherwise ("max").
std::optional<double> readNumber(const std::filesystem::path& file);

/// The number behind a word at the begin of a line, as in /proc/meminfo and cgroup's *.stat.
std::optional<double> numberAfter(const std::filesystem::path& file, const std::string& word);

}  // namespace glintmark
