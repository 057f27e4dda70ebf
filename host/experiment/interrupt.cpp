#include "host/experiment/interrupt.h"

#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
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
std::atomic<std::int64_t> seen_at_ns = 0;

// timeout(1), and whoever hands signals on, asks a process and its group: one request comes twice.
constexpr std::int64_t kOneRequest_ns = 300'000'000;

void noteSignal(int signal) {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t now_ns = now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
  if (signal_seen == 0) seen_at_ns = now_ns;
  const bool is_first = signal_seen == 0 || one_of_many != 0;
  if (is_first) signal_seen = signal;
  if (is_first || now_ns - seen_at_ns < kOneRequest_ns) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
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
    struct sigaction before = {};  // asked first: none that is ignored may be seen meanwhile
    sigaction(kEndRequests[i], nullptr, &before);
    previous_[i] =
        before.sa_handler == SIG_IGN ? SIG_IGN : std::signal(kEndRequests[i], noteSignal);
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
