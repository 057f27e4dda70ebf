#include "host/report/record/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>

#include "host/core/error.h"

namespace glintmark {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLockName = ".lock";

// How often, and how long each time, the children of a holder that was killed are waited for: they
// share its lock and end a moment after it.
constexpr int kMostWaits = 250;
constexpr std::chrono::milliseconds kWait{20};

// The process that the holder has written itself to be; 0: none.
pid_t holderOf(int descriptor) {
  char text[32] = {};
  const ssize_t size = pread(descriptor, text, sizeof(text) - 1, 0);
  pid_t holder = 0;
  if (size > 0) std::from_chars(text, text + size, holder);
  return holder;
}

bool isGone(pid_t process) {
  return process > 0 && kill(process, 0) != 0 && errno == ESRCH;
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
    for (int waits = 0; flock(descriptor_, LOCK_EX | LOCK_NB) != 0; ++waits) {
      if (errno != EWOULDBLOCK) return;
      const pid_t holder = holderOf(descriptor_);
      if (isGone(holder) && waits < kMostWaits) {
        std::this_thread::sleep_for(kWait);
        continue;
      }
      close(descriptor_);
      throw Error(fmt::format("{} is in use by another run ({}); wait for it or {}", what,
                              holder > 0 ? fmt::format("process {}", holder) : "another process",
                              advice));
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
