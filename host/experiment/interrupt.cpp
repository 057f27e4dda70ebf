#include "host/experiment/interrupt.h"

#include <csignal>

namespace glintmark {
namespace {

constexpr int kSignalExit = 128;

volatile std::sig_atomic_t signal_seen = 0;

void noteSignal(int signal) {
  signal_seen = signal;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  signal_seen = 0;
  previous_interrupt_ = std::signal(SIGINT, noteSignal);
  previous_terminate_ = std::signal(SIGTERM, noteSignal);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, previous_interrupt_);
  std::signal(SIGTERM, previous_terminate_);
}

bool InterruptGuard::interrupted() {
  return signal_seen != 0;
}

int InterruptGuard::exitCode() {
  return kSignalExit + (signal_seen != 0 ? signal_seen : SIGINT);
}

}  // namespace glintmark
