#include "host/core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <mutex>
#include <random>
#include <set>
#include <vector>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/core/output_files.h"

namespace glintmark {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const char* action, const fs::path& path, int error_number) {
  throw Error(fmt::format("cannot {} {}: {}", action, path.string(), std::strerror(error_number)));
}

// Bytes of a target's name in that of its temporary file: names have 255 at most.
constexpr std::size_t kMostNameBytes = 200;

constexpr std::size_t kRandomDigits = 16;

// ".NAME.RANDOM.PID.tmp".
std::string tempName(const std::string& target) {
  static std::random_device device;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto random = static_cast<std::uint64_t>(device()) << 32 | device();
  return fmt::format(".{}.{:016x}.{}.tmp", target.substr(0, kMostNameBytes), random, getpid());
}

// The process in the name of a temporary file, or 0: those of other programs are theirs.
pid_t ownerOf(const std::string& name) {
  constexpr std::string_view kEnd = ".tmp";
  if (!name.starts_with('.') || !name.ends_with(kEnd)) return 0;
  const std::size_t stop = name.size() - kEnd.size();
  const std::size_t dot = name.rfind('.', stop - 1);
  if (dot < kRandomDigits + 2 || name[dot - kRandomDigits - 1] != '.') return 0;
  const std::string_view random = std::string_view(name).substr(dot - kRandomDigits, kRandomDigits);
  if (random.find_first_not_of("0123456789abcdef") != std::string_view::npos) return 0;
  pid_t owner = 0;
  const auto [end, error] = std::from_chars(name.data() + dot + 1, name.data() + stop, owner);
  return error == std::errc() && end == name.data() + stop ? owner : 0;
}

// Is a file held by its writer, perhaps on another machine or in another container?
bool isLocked(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(descriptor);
  return locked;
}

// Once a folder and process: a folder may hold thousands of files.
void cleanOnce(const fs::path& folder) {
  static std::set<std::string> cleaned;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  if (cleaned.insert(folder.string()).second) removeAbandonedFiles(folder);
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
  // /dev/stdout is a link to what may be a file: it would be replaced for everybody.
  const std::string name = target.string();
  if ((name.starts_with("/dev/") || name.starts_with("/proc/")) &&
      fs::is_symlink(fs::symlink_status(target, ignored)))
    throw Error(fmt::format("cannot write {}: it stands for another file; name that one", name));
  requireNoInput(target);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw Error(
        fmt::format("cannot write {}: there is no folder {}", target.string(), folder.string()));
  }
  cleanOnce(folder);
  // Two tries never meet the same name; a third would not help either.
  for (int tries = 0; descriptor_ < 0 && tries < 2; ++tries) {
    temp_ = folder / tempName(target.filename().string());
    descriptor_ = open(temp_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (descriptor_ < 0 && errno != EEXIST) fail("write", target, errno);
  }
  if (descriptor_ < 0) fail("write", target, errno);
  flock(descriptor_, LOCK_EX | LOCK_NB);
}

AtomicFile::~AtomicFile() {
  if (!committed_) unlink(temp_.c_str());
  close(descriptor_);
}

void AtomicFile::commit(Durability durability) {
  if (durability == Durability::kSynced) sync();
  if (std::rename(temp_.c_str(), target_.c_str()) != 0) fail("write", target_, errno);
  committed_ = true;
  noteWritten(target_);
}

void AtomicFile::sync() const {
  if (fsync(descriptor_) != 0) fail("write", target_, errno);
}

void removeAbandonedFiles(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> abandoned;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const pid_t owner = ownerOf(entry.path().filename().string());
    if (owner > 0 && kill(owner, 0) != 0 && errno == ESRCH && !isLocked(entry.path()))
      abandoned.push_back(entry.path());
  }
  for (const fs::path& file : abandoned) fs::remove(file, error);
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
  for (const std::string_view piece : pieces) writeAll(file.descriptor(), piece, target);
  file.commit(durability);
}

InputFile::InputFile(const fs::path& path, FileRole role) : path_(path) {
  // Without O_NONBLOCK a pipe would be waited for.
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) fail("read", path, errno);
  struct stat status {};
  const bool known = fstat(descriptor_, &status) == 0;
  const int stat_error = errno;
  if (known && S_ISREG(status.st_mode)) {
    size_bytes_ = static_cast<std::uint64_t>(status.st_size);
    if (role == FileRole::kOwn) return;
    try {
      noteInput(path, status.st_dev, status.st_ino);
    } catch (...) {
      close(descriptor_);
      throw;
    }
    return;
  }
  close(descriptor_);
  if (!known) fail("read", path, stat_error);
  if (S_ISDIR(status.st_mode)) fail("read", path, EISDIR);
  throw Error(fmt::format("cannot read {}: it is a device, a pipe or a socket, expected a file",
                          path.string()));
}

InputFile::~InputFile() {
  close(descriptor_);
}

std::size_t InputFile::read(char* bytes, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::read(descriptor_, bytes + done, count - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", path_, errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string readFile(const fs::path& path, FileRole role) {
  InputFile file(path, role);
  // Files of /proc tell no size; what grows while it is read is read up to here.
  constexpr std::size_t kMostOfUnknownSize = std::size_t{64} << 20;
  const std::uint64_t size = file.sizeBytes();
  requireMemory(size, path.string());
  std::string text;
  constexpr std::size_t kLeastPiece = 1 << 16;
  for (std::size_t piece = std::max<std::size_t>(size + 1, kLeastPiece);;) {
    const std::size_t read = text.size();
    text.resize(read + piece);
    const std::size_t got = file.read(text.data() + read, piece);
    text.resize(read + got);
    if (got < piece) return text;
    if (text.size() > size + kMostOfUnknownSize)
      throw Error(fmt::format("cannot read {}: it has no end", path.string()));
  }
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
