#include "host/core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "host/core/error.h"

namespace glintmark {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const char* action, const fs::path& path, int error_number) {
  throw Error(fmt::format("cannot {} {}: {}", action, path.string(), std::strerror(error_number)));
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : target_(target) {
  std::error_code ignored;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    throw Error(
        fmt::format("cannot write {}: it exists and is not a regular file; choose another "
                    "name",
                    target.string()));
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw Error(
        fmt::format("cannot write {}: there is no folder {}", target.string(), folder.string()));
  }
  temp_ = folder / fmt::format(".{}.{}.tmp", target.filename().string(), getpid());
  const int descriptor = open(temp_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) fail("write", target, errno);
  close(descriptor);
}

AtomicFile::~AtomicFile() {
  if (!committed_) unlink(temp_.c_str());
}

void AtomicFile::commit(Durability durability) {
  if (durability == Durability::kSynced) sync();
  if (std::rename(temp_.c_str(), target_.c_str()) != 0) fail("write", target_, errno);
  committed_ = true;
}

void AtomicFile::sync() const {
  const int descriptor = open(temp_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("write", target_, errno);
  const int synced = fsync(descriptor);
  const int sync_error = errno;
  close(descriptor);
  if (synced != 0) fail("write", target_, sync_error);
}

void writeAll(int descriptor, std::string_view text, const fs::path& path) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", path, errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void writeFile(const fs::path& target, std::string_view text) {
  writeFile(target, {text}, Durability::kSynced);
}

void writeFile(const fs::path& target, std::initializer_list<std::string_view> pieces,
               Durability durability) {
  AtomicFile file(target);
  const int descriptor = open(file.tempPath().c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail("write", target, errno);
  try {
    for (const std::string_view piece : pieces) writeAll(descriptor, piece, target);
  } catch (...) {
    close(descriptor);
    throw;
  }
  if (close(descriptor) != 0) fail("write", target, errno);
  file.commit(durability);
}

std::string readFile(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail("read", path, EISDIR);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("read", path, errno);
  // Its size at once, or in pieces where the system knows none, as of pipes and /proc.
  constexpr std::size_t kLeastPiece = 1 << 16;
  const std::uintmax_t size = fs::is_regular_file(path, ignored) ? fs::file_size(path, ignored) : 0;
  std::string text;
  for (std::size_t piece = std::max<std::size_t>(size + 1, kLeastPiece); stream;) {
    const std::size_t read = text.size();
    text.resize(read + piece);
    stream.read(text.data() + read, static_cast<std::streamsize>(piece));
    text.resize(read + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) fail("read", path, EIO);
  return text;
}

void requireWritableFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw Error(
        fmt::format("cannot create the results folder {}: {}", folder.string(), error.message()));
  }
  if (!fs::is_directory(folder)) {
    throw Error(
        fmt::format("{} is not a folder, so results cannot be written there", folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw Error(fmt::format("the results folder {} cannot be written: {}", folder.string(),
                            std::strerror(errno)));
  }
  requireWritableFile(folder / "write_test");
}

void requireWritableFile(const fs::path& file) {
  const AtomicFile probe(file);
}

}  // namespace glintmark
