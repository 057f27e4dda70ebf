// What a driver may change of the process that it is loaded into, and leave changed.
#pragma once
#include <sys/types.h>
#include <array>
#include <cfenv>
#include <csignal>
#include <string>

namespace glintmark {

/// Puts rounding, flushing to zero and traps of this thread back.
class FloatState {
 public:
  FloatState() { std::fegetenv(&before_); }
  ~FloatState() { std::fesetenv(&before_); }
  FloatState(const FloatState&) = delete;
  FloatState& operator=(const FloatState&) = delete;

 private:
  std::fenv_t before_{};
};

/// Puts these back: FloatState, locale, working directory, umask, what requests to end and broken
/// pipes do, the signals that this thread blocks, and the three standard files. Meanwhile what is
/// printed on standard output goes to standard error: tables stay tables. Not for two threads at
/// once.
class ProcessState {
 public:
  ProcessState();
  ~ProcessState();
  ProcessState(const ProcessState&) = delete;
  ProcessState& operator=(const ProcessState&) = delete;

 private:
  static constexpr std::array kSignals = {SIGINT,  SIGTERM, SIGHUP, SIGQUIT,
                                          SIGPIPE, SIGCHLD, SIGCONT};
  FloatState float_;
  std::string locale_;
  int folder_ = -1;
  mode_t umask_ = 0;
  std::array<struct sigaction, kSignals.size()> actions_{};
  sigset_t blocked_{};
  std::array<int, 3> files_ = {-1, -1, -1};
};

}  // namespace glintmark
