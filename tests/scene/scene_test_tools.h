// What the scene tests share: scenes written on the spot, and the text of an Error.
#pragma once
#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/core/error.h"
#include "host/scene/load_scene.h"

namespace glintmark {

/// A folder that lives as long as one test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');  // of parameterized tests
    path_ = std::filesystem::temp_directory_path() /
            ("glintmark_" + name + "_" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return (path_ / name).string();
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A small scene that loads: sections that the tests then break.
inline std::string sceneText(const std::string& mesh = "generator = \"plane\"",
                             const std::string& material = "", const std::string& more = "") {
  return "[mesh]\n" + mesh + "\n[[material]]\nname = \"paint\"\n" + material +
         "\n[[light]]\nname = \"sun\"\n[[view]]\nname = \"front\"\n" + more + "\n";
}

inline Scene load(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  SceneRequest request;
  request.scene = scene;
  request.overrides = overrides;
  return loadScene(request);
}

/// The message of the Error that `action` throws; a failure if it throws none.
inline std::string errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), kExitBadInput);
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return "";
}

/// The message has every one of `pieces` and is one line.
inline void expectMessage(const std::string& message, const std::vector<std::string>& pieces) {
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const std::string& piece : pieces) {
    EXPECT_NE(message.find(piece), std::string::npos) << "'" << piece << "' not in: " << message;
  }
}

/// The folder of real models: $GLINTMARK_DATA, else shared/data beside the source tree.
inline std::optional<std::filesystem::path> dataFolder() {
  const char* from_environment = std::getenv("GLINTMARK_DATA");
  const std::filesystem::path folder =
      from_environment != nullptr ? std::filesystem::path(from_environment)
                                  : std::filesystem::path(GLINTMARK_SOURCE_DIR) / "../shared/data";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) return std::nullopt;
  return folder;
}

}  // namespace glintmark
