#include "host/report/record/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

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

bool isRegular(int descriptor) {
  struct stat status = {};
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

// Has a holder removed the file between our opening and locking it?
bool isStillThere(int descriptor, const fs::path& file) {
  struct stat opened = {}, named = {};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder)
    : FolderLock(folder / kLockName, folder.string(), "choose another folder with -o") {}

FolderLock::FolderLock(const fs::path& file, const std::string& what, const std::string& advice)
    : file_(file) {
  while (true) {
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
    if (descriptor_ < 0 && errno == ELOOP)
      throw Error(fmt::format("{} is a symbolic link, expected a lock file or none; remove it",
                              file_.string()));
    if (descriptor_ < 0)
      throw Error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
    if (!isRegular(descriptor_)) {
      close(descriptor_);
      throw Error(fmt::format("{} is no regular file, expected a lock file or none; remove it",
                              file_.string()));
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return;
      const std::string holder = holderOf(descriptor_);
      close(descriptor_);
      throw Error(
          fmt::format("{} is in use by another run ({}); wait for it or {}", what, holder, advice));
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

}  // namespace glintmark
