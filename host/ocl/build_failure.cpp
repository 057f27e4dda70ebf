#include "host/ocl/build_failure.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>
#include <sstream>
#include <string_view>
#include <system_error>

#include "host/core/atomic_file.h"
#include "host/ocl/driver_text.h"
#include "host/ocl/kernel_folder.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

// Of a line that may have no end: what stands before the word, and after.
std::string aroundError(const std::string& line) {
  constexpr std::size_t kMostBefore = 120;
  const std::size_t at = line.find("error");
  return shownText(std::string_view(line).substr(at > kMostBefore ? at - kMostBefore : 0));
}

std::string firstErrorLine(const std::string& log) {
  std::istringstream lines(log);
  std::string first;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("error") != std::string::npos) return aroundError(line);
    if (first.empty()) first = shownText(line);
  }
  return first.empty() ? "the driver gave no log" : first;
}

// Empty if they could not be saved: the build error matters more than its dump.
std::string dump(const FailedBuild& failed) try {
  std::error_code error;
  std::string folder = (fs::temp_directory_path(error) / "glintmark-build-XXXXXX").string();
  if (error || !mkdtemp(folder.data())) return {};
  writeFile(fs::path(folder) / "options.txt", failed.options + "\n");
  writeFile(fs::path(folder) / "build.log", failed.log);
  for (const fs::path& file : kernelFiles(failed.kernel_folder)) {
    const fs::path copy = fs::path(folder) / file.lexically_relative(failed.kernel_folder);
    fs::create_directories(copy.parent_path(), error);
    fs::copy_file(file, copy, error);
  }
  return folder;
} catch (const Error&) {
  return {};
}

}  // namespace

Error reportFailedBuild(const FailedBuild& failed) {
  const std::string folder = dump(failed);
  return Error(fmt::format("kernel file '{}' does not build on '{}': {} ({})", failed.file,
                           failed.device, firstErrorLine(failed.log),
                           folder.empty() ? "options, log and sources could not be saved"
                                          : "options, log and sources are in " + folder));
}

}  // namespace glintmark
