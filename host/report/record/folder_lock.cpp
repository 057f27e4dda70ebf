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
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>

#include "host/core/error.h"

namespace glintmark {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLockName = ".lock";

// How often a lock is tried again, and after how long each time. A holder that was killed keeps it
// until the system has taken its memory and its children have ended, who share it: that may take
// seconds. Any other gets a moment, since an end is not seen at its every step.
constexpr int kMostTries = 500, kMostTriesWhileAlive = 25;
constexpr std::chrono::milliseconds kBetweenTries{20};

// The process that the holder has written itself to be; 0: none.
pid_t holderOf(int descriptor) {
  char text[32] = {};
  const ssize_t size = pread(descriptor, text, sizeof(text) - 1, 0);
  pid_t holder = 0;
  if (size > 0) std::from_chars(text, text + size, holder);
  return holder;
}

// The value of a line of /proc/PID/status; empty: there is none.
std::string statusOf(pid_t process, std::string_view name) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name) && line.size() > name.size() && line[name.size()] == ':')
      return line.substr(line.find_first_not_of(" \t", name.size() + 1));
  return {};
}

// Has the process ended, or is SIGKILL on its way to it? The watched child of a run that was killed
// is told by the system to end, and is still there for a moment.
bool isEnding(pid_t process) {
  if (process <= 0) return false;
  if (kill(process, 0) != 0) return errno == ESRCH;
  const std::string state = statusOf(process, "State");
  if (state.starts_with('Z') || state.starts_with('X')) return true;
  constexpr unsigned long long kKillBit = 1ULL << (SIGKILL - 1);
  for (const char* pending : {"SigPnd", "ShdPnd"})
    if (std::strtoull(statusOf(process, pending).c_str(), nullptr, 16) & kKillBit) return true;
  return false;
}

// Is there nothing but a holder's number, or what a machine that stopped left of it? Somebody
// else's file may go by the same name: it would be emptied, and removed at the end.
bool isOurs(int descriptor) {
  char text[32] = {};
  const ssize_t size = pread(descriptor, text, sizeof(text), 0);
  return size >= 0 && size < static_cast<ssize_t>(sizeof(text)) &&
         std::string_view(text, static_cast<std::size_t>(size))
                 .find_first_not_of(std::string_view("0123456789\n\0", 12)) ==
             std::string_view::npos;
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
    if (!isRegular(descriptor_) || !isOurs(descriptor_)) {
      close(descriptor_);
      throw Error(fmt::format("{} is not the lock file of a run, expected one or none; remove it",
                              file_.string()));
    }
    for (int tries = 1; flock(descriptor_, LOCK_EX | LOCK_NB) != 0; ++tries) {
      if (errno != EWOULDBLOCK) return;
      const pid_t holder = holderOf(descriptor_);
      if (tries < (isEnding(holder) ? kMostTries : kMostTriesWhileAlive)) {
        std::this_thread::sleep_for(kBetweenTries);
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
