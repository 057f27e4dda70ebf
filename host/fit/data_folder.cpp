#include "host/fit/data_folder.h"

#include <fmt/format.h>

#include <cstdlib>

#include "host/core/error.h"

namespace glintmark {
namespace fs = std::filesystem;
namespace {

fs::path dataFolder() {
  if (const char* folder = std::getenv("GLINTMARK_TABLES"); folder != nullptr && *folder != '\0') {
    return folder;
  }
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path beside = executable.parent_path();
    for (const fs::path& folder : {beside / "../share/glintmark/data", beside / "data"}) {
      if (fs::is_directory(folder, error)) return folder.lexically_normal();
    }
  }
  return GLINTMARK_DATA_SOURCE_DIR;
}

}  // namespace

fs::path findDataFile(const std::string& name) {
  fs::path file = dataFolder() / name;
  std::error_code error;
  if (fs::is_regular_file(file, error)) return file;
  throw Error(fmt::format("no data file {}; set GLINTMARK_TABLES to the folder that has it",
                          file.string()));
}

}  // namespace glintmark
