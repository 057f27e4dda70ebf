#include "host/core/process_end.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace glintmark {

void dieWithParent(pid_t parent, int exit_code) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(exit_code);
}

void endByDefault(std::span<const int> signals) {
  for (const int number : signals)
    if (signal(number, SIG_DFL) == SIG_IGN) signal(number, SIG_IGN);
}

void requireChildStatus() {
  signal(SIGCHLD, SIG_DFL);
}

int awaitProcess(pid_t child) {
  constexpr int kUnknown = 1 << 8;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return kUnknown;
  return status;
}

std::string howItEnded(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("ended with exit code {}", WEXITSTATUS(status));
  return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
}

}  // namespace glintmark
