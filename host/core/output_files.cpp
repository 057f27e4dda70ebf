#include "host/core/output_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "host/core/atomic_file.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;
using FileId = std::pair<dev_t, ino_t>;

// Locked for moments only: children are forked while other threads read.
std::mutex mutex;
bool guards = false;
std::map<FileId, fs::path> inputs;
std::vector<OutputFile> announced;

std::vector<OutputFile> outputsNow() {
  const std::lock_guard lock(mutex);
  return announced;
}

std::optional<FileId> idOf(const fs::path& file) {
  struct stat status = {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return FileId{status.st_dev, status.st_ino};
}

bool areOne(const std::string& a, const std::string& b) {
  const std::optional<FileId> first = idOf(a), second = idOf(b);
  if (first && second) return *first == *second;
  if (first || second || fs::path(a).filename() != fs::path(b).filename()) return false;
  // Names of files to be stay as they are spelt, unless they are absolute.
  std::error_code error;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
  if (error) return false;
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error), error);
  return !error && whole_a == whole_b;
}

[[noreturn]] void refuse(const std::string& option, const std::string& file) {
  throw OverwriteError(fmt::format("{}'{}' would be written over what is read; choose another name",
                                   option.empty() ? "" : option + " ", file));
}

}  // namespace

InputGuard::InputGuard() {
  const std::lock_guard lock(mutex);
  guards = true;
}

InputGuard::~InputGuard() {
  const std::lock_guard lock(mutex);
  guards = false;
  inputs.clear();
  announced.clear();
}

void announceOutputs(const std::vector<OutputFile>& outputs) {
  for (const OutputFile& output : outputs) {
    if (output.file.empty()) continue;
    for (const OutputFile& other : outputsNow())
      if (areOne(output.file, other.file))
        throw Error(fmt::format("{} '{}' is the file of {} too; choose another name", output.option,
                                output.file, other.option));
    const std::lock_guard lock(mutex);
    if (guards) announced.push_back(output);
  }
  for (const OutputFile& output : outputs)
    if (!output.file.empty()) requireWritableFile(output.file);
}

void noteInput(const fs::path& path, dev_t device, ino_t inode) {
  const FileId id(device, inode);
  {
    const std::lock_guard lock(mutex);
    if (!guards) return;
    std::error_code error;
    inputs.emplace(id, fs::absolute(path, error));
  }
  for (const OutputFile& output : outputsNow())
    if (idOf(output.file) == id) refuse(output.option, output.file);
}

void requireNoInput(const fs::path& target) {
  const std::optional<FileId> id = idOf(target);
  if (!id) return;
  fs::path input;
  {
    const std::lock_guard lock(mutex);
    const auto found = inputs.find(*id);
    if (found == inputs.end()) return;
    input = found->second;
  }
  if (idOf(input) != id) return;  // it is gone, and its number another's
  for (const OutputFile& output : outputsNow())
    if (areOne(output.file, target.string())) refuse(output.option, output.file);
  refuse("", target.string());
}

void noteWritten(const fs::path& target) {
  const std::lock_guard lock(mutex);
  std::erase_if(announced,
                [&](const OutputFile& output) { return output.file == target.string(); });
}

}  // namespace glintmark
