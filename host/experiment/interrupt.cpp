#include "host/experiment/interrupt.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <utility>

#include "host/parallel/ranks.h"

namespace glintmark {
namespace {

constexpr int kSignalExit = 128;

// mpirun kills what has not ended so many seconds after it was asked to; 1 unless it is told
// otherwise, which it passes on.
std::chrono::milliseconds patience() {
  const char* text = std::getenv("OMPI_MCA_odls_base_sigkill_timeout");
  const int seconds = text == nullptr ? 1 : std::max(1, std::atoi(text));
  return std::chrono::milliseconds(600) * seconds;
}

volatile std::sig_atomic_t signal_seen = 0, one_of_many = 0, continue_seen = 0;
volatile std::sig_atomic_t noted[std::size(kEndRequests)] = {};

void noteSignal(int signal) {
  signal_seen = signal;
  if (one_of_many != 0) return;
  for (std::size_t i = 0; i < std::size(kEndRequests); ++i)
    if (noted[i] != 0) std::signal(kEndRequests[i], SIG_DFL);
}

void noteContinue(int) {
  continue_seen = 1;
}

// For a rank that waits for others, one of which may have died.
void stopWaiting() {
  static std::optional<std::chrono::steady_clock::time_point> since;
  if (signal_seen == 0) return since.reset();
  const auto now = std::chrono::steady_clock::now();
  if (!since) since = now;
  if (now - *since > patience()) throw RankSilent("interrupted, and a rank did not answer");
}

}  // namespace

InterruptGuard::InterruptGuard() {
  signal_seen = 0;
  one_of_many = allRanks().size() > 1;
  whileWaiting(stopWaiting);
  for (std::size_t i = 0; i < std::size(kEndRequests); ++i) {
    previous_[i] = std::signal(kEndRequests[i], noteSignal);
    noted[i] = previous_[i] != SIG_IGN;
    if (noted[i] == 0) std::signal(kEndRequests[i], SIG_IGN);
  }
  if (one_of_many != 0) previous_continue_ = std::signal(SIGCONT, noteContinue);
}

InterruptGuard::~InterruptGuard() {
  whileWaiting(nullptr);
  for (std::size_t i = 0; i < std::size(kEndRequests); ++i)
    std::signal(kEndRequests[i], previous_[i]);
  if (one_of_many != 0) std::signal(SIGCONT, previous_continue_);
}

bool InterruptGuard::interrupted() {
  return signal_seen != 0;
}

bool InterruptGuard::endIsNear() {
  return std::exchange(continue_seen, 0) != 0;
}

int InterruptGuard::exitCode() {
  return kSignalExit + (signal_seen != 0 ? signal_seen : SIGINT);
}

}  // namespace glintmark
