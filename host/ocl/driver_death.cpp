#include "host/ocl/driver_death.h"

#include <unistd.h>

#include <string_view>

#include "host/core/error.h"

namespace glintmark {
namespace {

// PoCL aborts where hwloc sees no memory: in a root without /sys, or under `ulimit -v`.
constexpr std::string_view kSentence =
    "glintmark: an OpenCL driver ended the program while its devices were opened; PoCL does so "
    "without /sys or under a limit of memory, and OCL_ICD_VENDORS=FILE chooses one driver alone\n";

// Only what a signal handler may call.
extern "C" void sayThatADriverDied(int) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kSentence.data(), kSentence.size());
  _exit(kExitNoDevice);
}

}  // namespace

DriverDeath::DriverDeath() {
  struct sigaction action = {};
  action.sa_handler = sayThatADriverDied;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &before_[i]);
}

DriverDeath::~DriverDeath() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

}  // namespace glintmark
