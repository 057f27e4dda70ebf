// What is said if a driver ends the program while it is opened.
#pragma once
#include <array>
#include <csignal>

namespace glintmark {

/// As long as one lives, a driver that aborts or crashes ends the program with a sentence on stderr
/// and kExitNoDevice, not with a signal. For the calls that look for devices and open them, on one
/// thread. Handlers that a driver installs meanwhile stay.
class DriverDeath {
 public:
  DriverDeath();
  ~DriverDeath();
  DriverDeath(const DriverDeath&) = delete;
  DriverDeath& operator=(const DriverDeath&) = delete;

 private:
  static constexpr std::array kSignals = {SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGFPE};
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace glintmark
