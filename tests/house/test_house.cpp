// The tree of this project against the rules of the house.
#include <gtest/gtest.h>

#include <filesystem>

#include "host/core/atomic_file.h"
#include "tests/house/house.h"

namespace glintmark::house {
namespace {

namespace fs = std::filesystem;

const Files& projectFiles() {
  static const Files files = [] {
    Files all;
    const fs::path root = GLINTMARK_SOURCE_DIR;
    for (const char* area : {"host", "kernels", "bench", "tests", "fuzz", "docs", "data", "scenes"})
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / area)) {
        if (!entry.is_regular_file()) continue;
        const std::string path = entry.path().lexically_relative(root).string();
        const bool is_read = isSource(path) || entry.path().extension() == ".md" ||
                             entry.path().filename() == "CMakeLists.txt" ||
                             path == "host/order.txt";
        all[path] = is_read ? readFile(entry.path()) : "";
      }
    return all;
  }();
  return files;
}

Order projectOrder() {
  return parseOrder(projectFiles().at("host/order.txt"));
}

std::string listOf(const std::vector<std::string>& faults) {
  std::string text;
  for (const std::string& fault : faults) text += "\n  " + fault;
  return text;
}

TEST(House, IsReadWhole) {
  std::size_t includes = 0;
  for (const auto& [path, text] : projectFiles())
    if (isSource(path)) includes += includesOf(text).size();
  EXPECT_GT(includes, 1000u);
  EXPECT_TRUE(projectFiles().contains("kernels/types.h"));
}

TEST(House, OrderKnowsEveryFolderOfHostOnce) {
  std::multiset<std::string> ordered;
  for (const auto& floor : projectOrder().floors) ordered.insert(floor.begin(), floor.end());
  std::multiset<std::string> there;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(GLINTMARK_SOURCE_DIR) / "host"))
    if (entry.is_directory()) there.insert(entry.path().filename().string());
  EXPECT_EQ(ordered, there);
}

TEST(House, WhatIsUnnamedIsCalledLikeNothingElseOfItsFolder) {
  const auto faults = sharedUnnamed(projectFiles());
  EXPECT_TRUE(faults.empty()) << listOf(faults);
}

TEST(House, EveryIncludeKeepsToTheOrder) {
  const auto faults = includeFaults(projectFiles(), projectOrder());
  EXPECT_TRUE(faults.empty()) << listOf(faults);
}

TEST(House, NoIncludesGoInCircles) {
  const auto faults = circles(projectFiles());
  EXPECT_TRUE(faults.empty()) << listOf(faults);
}

TEST(House, EveryFolderSaysWhatItIs) {
  const auto faults = readmeFaults(projectFiles(), projectOrder(), definedPrograms(projectFiles()));
  EXPECT_TRUE(faults.empty()) << listOf(faults);
}

}  // namespace
}  // namespace glintmark::house
