#include "host/experiment/interrupt.h"

#include <csignal>

namespace glintmark {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

void noteInterrupt(int signal) {
  interrupt_seen = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupt_seen = 0;
  previous_ = std::signal(SIGINT, noteInterrupt);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, previous_);
}

bool InterruptGuard::interrupted() {
  return interrupt_seen != 0;
}

}  // namespace glintmark
