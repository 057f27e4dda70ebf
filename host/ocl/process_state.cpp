#include "host/ocl/process_state.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>

namespace glintmark {
namespace {

// The system tells only by setting another.
mode_t currentUmask() {
  const mode_t mask = umask(077);
  umask(mask);
  return mask;
}

bool isOpen(int file) {
  return fcntl(file, F_GETFD) >= 0;
}

bool isSameAction(const struct sigaction& a, const struct sigaction& b) {
  return a.sa_flags == b.sa_flags &&
         ((a.sa_flags & SA_SIGINFO) != 0 ? a.sa_sigaction == b.sa_sigaction
                                         : a.sa_handler == b.sa_handler);
}

}  // namespace

ProcessState::ProcessState() {
  if (const char* locale = std::setlocale(LC_ALL, nullptr)) locale_ = locale;
  folder_ = open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  umask_ = currentUmask();
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &actions_[i]);
  pthread_sigmask(SIG_SETMASK, nullptr, &blocked_);
  std::fflush(stdout);
  for (int file = 0; file < 3; ++file) files_[file] = fcntl(file, F_DUPFD_CLOEXEC, 3);
  if (files_[STDOUT_FILENO] >= 0 && files_[STDERR_FILENO] >= 0) dup2(STDERR_FILENO, STDOUT_FILENO);
}

ProcessState::~ProcessState() {
  std::fflush(stdout);
  for (int file = 0; file < 3; ++file) {
    if (files_[file] < 0) continue;
    if (file == STDOUT_FILENO || !isOpen(file)) dup2(files_[file], file);
    close(files_[file]);
  }
  pthread_sigmask(SIG_SETMASK, &blocked_, nullptr);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    struct sigaction now = {};
    sigaction(kSignals[i], nullptr, &now);
    if (!isSameAction(now, actions_[i])) sigaction(kSignals[i], &actions_[i], nullptr);
  }
  if (currentUmask() != umask_) umask(umask_);
  if (folder_ >= 0) {
    [[maybe_unused]] const int moved = fchdir(folder_);
    close(folder_);
  }
  const char* locale = std::setlocale(LC_ALL, nullptr);
  if (locale && locale_ != locale) std::setlocale(LC_ALL, locale_.c_str());
}

}  // namespace glintmark
