#include "host/report/record/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string>
#include <vector>

#include "host/core/error.h"

namespace glintmark {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLockName = ".lock";

// What the holder has written about itself.
std::string holderOf(int descriptor) {
  char text[32] = {};
  const ssize_t size = pread(descriptor, text, sizeof(text) - 1, 0);
  return size > 0 ? fmt::format("process {}", text) : std::string("another process");
}

// Has a holder removed the file between our opening and locking it?
bool isStillThere(int descriptor, const fs::path& file) {
  struct stat opened = {}, named = {};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// The process in ".NAME.PID.tmp", or 0.
pid_t ownerOf(const std::string& name) {
  constexpr std::string_view kEnd = ".tmp";
  if (!name.starts_with('.') || !name.ends_with(kEnd)) return 0;
  const std::size_t stop = name.size() - kEnd.size();
  const std::size_t dot = name.rfind('.', stop - 1);
  pid_t owner = 0;
  const auto [end, error] = std::from_chars(name.data() + dot + 1, name.data() + stop, owner);
  return dot > 0 && error == std::errc() && end == name.data() + stop ? owner : 0;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : file_(folder / kLockName) {
  while (true) {
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
      throw Error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return;
      const std::string holder = holderOf(descriptor_);
      close(descriptor_);
      throw Error(
          fmt::format("{} is in use by another run ({}); wait for it or choose another folder with "
                      "-o",
                      folder.string(), holder));
    }
    if (isStillThere(descriptor_, file_)) break;
    close(descriptor_);
  }
  const std::string self = std::to_string(getpid());
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, self.data(), self.size(), 0) < 0)
    errno = 0;  // a full disk: the lock holds without a name in it
}

FolderLock::~FolderLock() {
  unlink(file_.c_str());
  close(descriptor_);
}

void removeAbandonedFiles(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> abandoned;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const pid_t owner = ownerOf(entry.path().filename().string());
    if (owner > 0 && kill(owner, 0) != 0 && errno == ESRCH) abandoned.push_back(entry.path());
  }
  for (const fs::path& file : abandoned) fs::remove(file, error);
}

}  // namespace glintmark
