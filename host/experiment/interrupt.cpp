#include "host/experiment/interrupt.h"

#include <chrono>
#include <csignal>
#include <optional>

#include "host/parallel/ranks.h"

namespace glintmark {
namespace {

constexpr int kSignalExit = 128;

// mpirun kills what has not ended a second after it was asked to.
constexpr std::chrono::milliseconds kPatience{400};

volatile std::sig_atomic_t signal_seen = 0, one_of_many = 0;

void noteSignal(int signal) {
  signal_seen = signal;
  if (one_of_many != 0) return;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

// For a rank that waits for others, one of which may have died.
void stopWaiting() {
  static std::optional<std::chrono::steady_clock::time_point> since;
  if (signal_seen == 0) return since.reset();
  const auto now = std::chrono::steady_clock::now();
  if (!since) since = now;
  if (now - *since > kPatience) throw RankSilent("interrupted, and a rank did not answer");
}

}  // namespace

InterruptGuard::InterruptGuard() {
  signal_seen = 0;
  one_of_many = allRanks().size() > 1;
  whileWaiting(stopWaiting);
  previous_interrupt_ = std::signal(SIGINT, noteSignal);
  previous_terminate_ = std::signal(SIGTERM, noteSignal);
}

InterruptGuard::~InterruptGuard() {
  whileWaiting(nullptr);
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
