#include "host/experiment/watched_child.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "host/core/error.h"
#include "host/core/process_end.h"
#include "host/experiment/interrupt.h"

namespace glintmark {
namespace {

constexpr int kSignalExitCode = 128;

volatile std::sig_atomic_t watched_child = 0, asked_to_end = 0;

// A terminal's Ctrl-C reaches the child by itself, and a second one would end it at once.
extern "C" void handOn(int number, siginfo_t* info, void*) {
  if (number != SIGCONT) asked_to_end = 1;
  if (info->si_code <= 0 && watched_child > 0) kill(watched_child, number);
}

void handOnSignals(bool to_another_group) {
  struct sigaction action = {};
  action.sa_sigaction = handOn;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  for (const int number : kEndRequests) {
    struct sigaction before = {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
  if (to_another_group) sigaction(SIGCONT, &action, nullptr);
}

// The signals wait meanwhile, so that none is lost before the child is known.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int number : kEndRequests) sigaddset(&held, number);
    sigaddset(&held, SIGCONT);
    sigprocmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_ = {};
};

}  // namespace

pid_t startChild(bool own_group) {
  const HeldSignals held;
  std::fflush(nullptr);  // or both would write what waits
  const pid_t parent = getpid(), child = fork();
  if (child > 0) {
    watched_child = child;
    handOnSignals(own_group);
  } else if (child == 0) {
    if (own_group) setpgid(0, 0);
    endByDefault(kEndRequests);
    dieWithParent(parent, kExitCheckFailed);
  }
  return child;
}

int awaitChild(pid_t child) {
  const int status = awaitProcess(child);
  watched_child = 0;
  return status;
}

bool wasAskedToEnd(int status) {
  constexpr int kRequests[] = {SIGINT, SIGTERM, SIGKILL, SIGHUP, SIGQUIT};
  return asked_to_end != 0 ||
         (WIFSIGNALED(status) &&
          std::ranges::find(kRequests, WTERMSIG(status)) != std::end(kRequests));
}

std::string whyItEnded(int status) {
  const bool killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  return howItEnded(status) + (killed ? "; the system does so where memory runs out" : "");
}

int exitCodeOf(int status) {
  return WIFSIGNALED(status) ? kSignalExitCode + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace glintmark
