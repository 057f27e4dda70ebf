#include "host/experiment/survival.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/parallel/ranks.h"

namespace glintmark {
namespace {

constexpr std::size_t kMostNameBytes = 4096;
constexpr int kSignalExitCode = 128;

// Of this process and its child: the case at hand, empty for none. Null where nobody watches.
char* shared_name = nullptr;
std::vector<LostCase> lost_cases;
double lost_seconds = 0;

volatile std::sig_atomic_t watched_child = 0, asked_to_end = 0;

// A terminal's Ctrl-C reaches the child by itself, and a second one would end it at once.
extern "C" void handOn(int number, siginfo_t* info, void*) {
  asked_to_end = 1;
  if (info->si_code <= 0 && watched_child > 0) kill(watched_child, number);
}

void handOnSignals() {
  struct sigaction action = {};
  action.sa_sigaction = handOn;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
}

// The two signals wait meanwhile, so that none is lost before the child is known.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int number : {SIGINT, SIGTERM}) sigaddset(&held, number);
    sigprocmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_ = {};
};

// 0 in the child, which dies with its parent; less than 0 if there can be none.
pid_t startChild() {
  const HeldSignals held;
  std::fflush(nullptr);  // or both would write what waits
  const pid_t parent = getpid(), child = fork();
  if (child > 0) {
    watched_child = child;
    handOnSignals();
  } else if (child == 0) {
    for (const int number : {SIGINT, SIGTERM}) signal(number, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kExitCheckFailed);
  }
  return child;
}

int awaitChild(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  watched_child = 0;
  return status;
}

bool wasAskedToEnd(int status) {
  constexpr int kRequests[] = {SIGINT, SIGTERM, SIGKILL, SIGHUP, SIGQUIT};
  return asked_to_end != 0 ||
         (WIFSIGNALED(status) &&
          std::ranges::find(kRequests, WTERMSIG(status)) != std::end(kRequests));
}

// What the parent of a child that ended so returns.
int exitCodeOf(int status) {
  if (!WIFSIGNALED(status)) return WEXITSTATUS(status);
  if (!wasAskedToEnd(status) || WTERMSIG(status) == SIGKILL)
    fmt::print(stderr, "glintmark: the process that measures {}{}\n", howItEnded(status),
               WTERMSIG(status) == SIGKILL ? "; the system does so where memory runs out" : "");
  return kSignalExitCode + WTERMSIG(status);
}

}  // namespace

int runSurviving(bool quiet, const std::function<int(bool first)>& measure) {
  // A rank is the process that its launcher knows.
  if (&allRanks() != &aloneRanks()) return measure(true);
  const Stopwatch watch;
  void* const page =
      mmap(nullptr, kMostNameBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) return measure(true);
  shared_name = static_cast<char*>(page);
  while (true) {
    lost_seconds = lost_cases.empty() ? 0 : watch.elapsedNs() * 1e-9;
    const pid_t child = startChild();
    if (child <= 0) return measure(lost_cases.empty());
    const int status = awaitChild(child);
    if (*shared_name == '\0' || wasAskedToEnd(status)) return exitCodeOf(status);
    lost_cases.push_back({shared_name, howItEnded(status)});
    *shared_name = '\0';
    if (!quiet)
      fmt::print(stderr, "note: {} is lost, its process {}; going on with the next\n",
                 lost_cases.back().name, lost_cases.back().how);
  }
}

const std::vector<LostCase>& lostCases() {
  return lost_cases;
}

void requireMeasured(std::size_t records) {
  if (records > 0 || lost_cases.empty()) return;
  throw DeviceError(fmt::format("nothing could be measured: {} is lost, its process {}",
                                lost_cases.back().name, lost_cases.back().how));
}

double secondsOfLostProcesses() {
  return lost_seconds;
}

CaseAtHand::CaseAtHand(const std::string& name) {
  if (shared_name == nullptr) return;
  const std::size_t size = std::min(name.size(), kMostNameBytes - 1);
  std::memcpy(shared_name, name.data(), size);
  shared_name[size] = '\0';
}

CaseAtHand::~CaseAtHand() {
  if (shared_name != nullptr) *shared_name = '\0';
}

std::string howItEnded(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("ended with exit code {}", WEXITSTATUS(status));
  return fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
}

}  // namespace glintmark
