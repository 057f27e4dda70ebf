// Ctrl-C during long measurements.
#pragma once
#include <stdexcept>

namespace glintmark {

/// The user pressed Ctrl-C; the message says what is kept.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Exit code of a program that SIGINT ended: 128 + 2.
inline constexpr int kExitInterrupted = 130;

/// While it lives, the first SIGINT only sets a flag; a second one ends the program at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool interrupted();

 private:
  void (*previous_)(int);
};

}  // namespace glintmark
