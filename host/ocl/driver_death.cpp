#include "host/ocl/driver_death.h"

#include <unistd.h>

#include <string_view>

#include "host/core/error.h"
#include "host/core/last_words.h"

namespace glintmark {
namespace {

// PoCL aborts where hwloc sees no memory: in a root without /sys, or under `ulimit -v`.
constexpr std::string_view kSentence =
    "glintmark: an OpenCL driver ended the program while its devices were opened; PoCL does so "
    "without /sys, under a limit of memory or by a POCL_ variable out of range, and "
    "OCL_ICD_VENDORS=FILE chooses one driver alone\n";

volatile std::sig_atomic_t living = 0;

// Only what a signal handler may call. Drivers that put handlers of their own over this one may
// hand on to it later, when it has nothing to say.
extern "C" void sayThatADriverDied(int number) {
  if (living == 0) {
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kSentence.data(), kSentence.size());
  leaveExitCode(kExitNoDevice);
  _exit(kExitNoDevice);
}

}  // namespace

DriverDeath::DriverDeath() {
  struct sigaction action = {};
  action.sa_handler = sayThatADriverDied;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &before_[i]);
  living = living + 1;
}

// What the driver put in place stays: PoCL passes over integer divisions by zero in kernels so.
DriverDeath::~DriverDeath() {
  living = living - 1;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    struct sigaction now = {};
    sigaction(kSignals[i], nullptr, &now);
    const bool own = (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == sayThatADriverDied;
    if (own) sigaction(kSignals[i], &before_[i], nullptr);
  }
}

}  // namespace glintmark
