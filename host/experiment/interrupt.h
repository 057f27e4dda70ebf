// Ctrl-C, or a request to end, during long measurements.
#pragma once
#include <array>
#include <csignal>
#include <stdexcept>

namespace glintmark {

/// Ctrl-C, a request of the system, and the end of the terminal.
inline constexpr int kEndRequests[] = {SIGINT, SIGTERM, SIGHUP};

/// The user pressed Ctrl-C, or the system asked to end; the message says what is kept.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The same while this rank waited for another that did not answer; it may have died.
class RankSilent : public Interrupted {
 public:
  using Interrupted::Interrupted;
};

/// While it lives, the first of kEndRequests only sets a flag; a second one ends the program at
/// once, but for one that comes with it, or unless it is one of several ranks: their launcher kills
/// those that take too long. What was ignored before, as nohup has it, stays ignored. A rank that
/// waits for others after a signal, which may never come, throws RankSilent after a while.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool interrupted();
  /// Has this rank had a SIGCONT since it was last asked? mpirun sends one a second before SIGTERM,
  /// and that a second before it kills: what takes long to save should be saved now.
  static bool endIsNear();
  /// Exit code of a program that the signal of the last guard ended: 128 + its number; as for
  /// SIGINT if there was none.
  static int exitCode();

 private:
  std::array<void (*)(int), std::size(kEndRequests)> previous_{};
  void (*previous_continue_)(int) = nullptr;
};

}  // namespace glintmark
