#include "host/experiment/survival.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "host/core/error.h"
#include "host/core/last_words.h"
#include "host/core/process_end.h"
#include "host/core/stopwatch.h"
#include "host/experiment/watched_child.h"
#include "host/parallel/ranks.h"

namespace glintmark {
namespace {

constexpr std::size_t kMostNameBytes = 4096;
// Of this process and its child: the case at hand, empty for none. Null where nobody watches.
char* shared_name = nullptr;
std::vector<LostCase> lost_cases;
double lost_seconds = 0;

void share(const std::string& name) {
  if (shared_name == nullptr) return;
  const std::size_t size = std::min(name.size(), kMostNameBytes - 1);
  std::memcpy(shared_name, name.data(), size);
  shared_name[size] = '\0';
}

std::string fullName(const std::string& table, const std::string& case_name) {
  return table + " " + case_name;
}

bool isLostName(const std::string& name) {
  return std::ranges::find(lost_cases, name, &LostCase::name) != lost_cases.end();
}

// Did the process end itself, or did somebody else send it a signal?
bool isOwnDoing(int status) {
  constexpr std::array kFaults = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP, SIGSYS};
  return !WIFSIGNALED(status) || std::ranges::find(kFaults, WTERMSIG(status)) != kFaults.end();
}

// Whatever the child says of itself; what ended it otherwise it could not say.
int lastExitCode(int status) {
  if (const std::optional<int> code = leftExitCode()) return *code;
  const bool killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  const bool unheard = WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE;  // as `| head` has it
  if (unheard || (wasAskedToEnd(status) && !killed)) return exitCodeOf(status);
  if (const std::string hang = leftHang(); !hang.empty()) {
    fmt::print(stderr, "glintmark: the OpenCL driver was {}\n", hang);
    return kExitNoDevice;
  }
  const std::string call = isOwnDoing(status) ? callUnderWay() : "";
  if (!call.empty()) {
    fmt::print(stderr, "glintmark: an OpenCL driver ended the program while {}: its process {}\n",
               call, howItEnded(status));
    return kExitNoDevice;
  }
  fmt::print(stderr, "glintmark: the process that did the work {}\n", whyItEnded(status));
  return std::max<int>(exitCodeOf(status), kExitCheckFailed);
}

// Both pages that a child writes.
bool shareWithChild() {
  return shareCaseAtHand() && shareLastWords();
}

}  // namespace

int runSurviving(bool quiet, const std::function<int(bool first)>& measure) {
  // A rank is the process that its launcher knows.
  if (&allRanks() != &aloneRanks()) return measure(true);
  const Stopwatch watch;
  if (!shareWithChild()) return measure(true);
  while (true) {
    lost_seconds = lost_cases.empty() ? 0 : watch.elapsedNs() * 1e-9;
    forgetLastWords();
    const pid_t child = startChild();
    if (child < 0) unshareLastWords();
    if (child <= 0) return measure(lost_cases.empty());
    const int status = awaitChild(child);
    if (leftExitCode() || *shared_name == '\0' || wasAskedToEnd(status))
      return lastExitCode(status);
    if (isLostName(shared_name)) {  // or it would be lost for ever
      fmt::print(stderr, "glintmark: {} is lost again, its process {}\n", shared_name,
                 howItEnded(status));
      return kExitCheckFailed;
    }
    const std::string hang = leftHang();
    lost_cases.push_back({shared_name, hang.empty() ? howItEnded(status) : "was " + hang});
    *shared_name = '\0';
    if (!quiet)
      fmt::print(stderr, "note: {} is lost, its process {}; going on with the next\n",
                 lost_cases.back().name, lost_cases.back().how);
  }
}

int runWatched(const std::function<int()>& work) {
  if (&allRanks() != &aloneRanks() || !shareLastWords()) return work();
  forgetLastWords();
  const pid_t child = startChild();
  if (child < 0) unshareLastWords();
  return child <= 0 ? work() : lastExitCode(awaitChild(child));
}

bool shareCaseAtHand() {
  if (shared_name != nullptr) return true;
  void* const page =
      mmap(nullptr, kMostNameBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) return false;
  shared_name = static_cast<char*>(page);
  return true;
}

std::string caseAtHand() {
  return shared_name != nullptr ? shared_name : "";
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

bool isLost(const std::string& table, const std::string& case_name) {
  return isLostName(fullName(table, case_name));
}

CaseAtHand::CaseAtHand(const std::string& table, const std::string& case_name)
    : before_(caseAtHand()) {
  share(fullName(table, case_name));
}

CaseAtHand::~CaseAtHand() {
  share(before_);
}

}  // namespace glintmark
