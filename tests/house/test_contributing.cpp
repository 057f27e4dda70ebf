// CONTRIBUTING.md names files that are there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "host/core/atomic_file.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

const fs::path kProject = GLINTMARK_SOURCE_DIR;

// Files and folders below the project's tracked folders, from its root: "host/ocl/device.h".
const std::vector<std::string>& projectPaths() {
  static const std::vector<std::string> paths = [] {
    std::vector<std::string> found;
    for (const fs::directory_entry& top : fs::directory_iterator(kProject)) {
      const std::string name = top.path().filename().string();
      found.push_back(name + (top.is_directory() ? "/" : ""));
      if (!top.is_directory() || name.starts_with("build") || name == ".git") continue;
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top))
        found.push_back(entry.path().lexically_relative(kProject).string() +
                        (entry.is_directory() ? "/" : ""));
    }
    return found;
  }();
  return paths;
}

// Is it a path of the project? "<name>" stands for any one name.
bool existsAs(const std::string& path) {
  static const std::regex special(R"([.+*?()\[\]{}|^$\\])"), placeholder("<[a-z_]+>");
  const std::string escaped = std::regex_replace(path, special, R"(\$&)");
  const std::regex pattern(std::regex_replace(escaped, placeholder, "[^/]+") + "/?");
  return std::ranges::any_of(
      projectPaths(), [&](const std::string& known) { return std::regex_match(known, pattern); });
}

// What stands between backticks and is written as a path: "scenes/<name>.toml".
std::vector<std::string> pathsIn(const std::string& text) {
  static const std::regex quoted(R"(`([A-Za-z0-9_.<>-]*[/.][A-Za-z0-9_./<>-]*)`)");
  std::vector<std::string> paths;
  for (std::sregex_iterator it(text.begin(), text.end(), quoted), end; it != end; ++it)
    paths.push_back((*it)[1]);
  return paths;
}

TEST(Contributing, NamesFilesThatExist) {
  const std::vector<std::string> paths = pathsIn(readFile(kProject / "CONTRIBUTING.md"));
  EXPECT_GT(paths.size(), 25u);
  for (const std::string& path : paths) EXPECT_TRUE(existsAs(path)) << path;
}

TEST(Contributing, SaysHowToAddEachKind) {
  const std::string text = readFile(kProject / "CONTRIBUTING.md");
  for (const char* kind : {"method", "effect", "table", "knob", "check", "scene"})
    EXPECT_TRUE(std::regex_search(text, std::regex(std::string(R"(\*\*An? ([a-z]+ )?)") + kind)))
        << kind;
}

TEST(Contributing, ATestCanFindAPathThatIsNotThere) {
  EXPECT_EQ(pathsIn("see `host/none.cpp`, `./run test`, `KNOB` and `a/<name>.b`"),
            (std::vector<std::string>{"host/none.cpp", "a/<name>.b"}));
  EXPECT_FALSE(existsAs("host/none.cpp"));
  EXPECT_FALSE(existsAs("host/core/<name>.toml"));
  EXPECT_TRUE(existsAs("host/core/<name>.h"));
  EXPECT_TRUE(existsAs("host/core/"));
  EXPECT_TRUE(existsAs("README.md"));
}

}  // namespace
}  // namespace glintmark
