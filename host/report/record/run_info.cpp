#include "host/report/record/run_info.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "glintmark_git_version.h"
#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/report/record/machine.h"

namespace glintmark {
namespace {

// The value of the first "key : value" line of a /proc file, or an empty string.
std::string procValue(const char* file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::size_t value = line.find_first_not_of(" \t", colon + 1);
    return value == std::string::npos ? "" : line.substr(value);
  }
  return "";
}

}  // namespace

std::optional<std::time_t> sourceDate() {
  const char* fixed = std::getenv("SOURCE_DATE_EPOCH");
  if (fixed == nullptr || *fixed == '\0') return std::nullopt;
  const std::string_view text = fixed;
  std::time_t seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  constexpr std::time_t kMostSeconds = 253402300799;  // the end of year 9999
  if (error != std::errc() || end != text.data() + text.size() || seconds < 0 ||
      seconds > kMostSeconds)
    throw Error(fmt::format("SOURCE_DATE_EPOCH is '{}', expected seconds since 1970", text));
  return seconds;
}

std::string gitVersion() {
  return GLINTMARK_GIT_VERSION;
}

RunInfo describeHost(std::span<const char* const> command_line) {
  RunInfo run;
  run.date =
      fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(sourceDate().value_or(std::time(nullptr))));
  run.git = gitVersion();
  for (const char* word : command_line) {
    if (!run.command.empty()) run.command += ' ';
    run.command += word;
  }
  run.cpu = procValue("/proc/cpuinfo", "model name");
  run.cores = usableCores();
  run.memory_bytes = availableMemoryBytes();
  run.begin = machineState();
  return run;
}

unsigned long long availableMemoryBytes() {
  return freeMemoryBytes();
}

}  // namespace glintmark
