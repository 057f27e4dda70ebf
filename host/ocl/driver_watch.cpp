#include "host/ocl/driver_watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

#include "host/core/error.h"
#include "host/core/last_words.h"
#include "host/core/progress.h"

namespace glintmark {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr std::chrono::milliseconds kLook{200};

struct Watched {
  std::mutex mutex;
  std::list<WatchedCall> calls;
  pid_t thread_of = 0;  // the process whose thread looks; a fork leaves threads behind
};

// Never destroyed: its thread outlives main.
Watched& watched() {
  static Watched& all = *new Watched;
  return all;
}

// Under 0 if the variable is not there or no number of seconds.
double chosenEnd_s() {
  const char* text = std::getenv("GLINTMARK_DRIVER_S");
  char* end = nullptr;
  const double value = text && *text ? std::strtod(text, &end) : -1;
  return end && *end == '\0' ? value : -1;
}

void endHung(const WatchedCall& call, Clock::duration took) {
  const auto took_s = std::chrono::duration_cast<seconds>(took).count();
  leaveHang(fmt::format("{} and gave no answer within {} s", call.what, took_s));
  if (!hasHearer())
    fmt::print(stderr, "glintmark: the OpenCL driver was {} and gave no answer within {} s\n",
               call.what, took_s);
  _exit(kExitNoDevice);
}

void look(WatchedCall& call, Clock::time_point now) {
  const auto took = now - call.begin;
  if (took >= call.patience.end) endHung(call, took);
  if (took < call.next_note) return;
  if (!Progress::areSilent())
    fmt::print(stderr, "note: the driver has been {} for {} s and is not done\n", call.what,
               call.next_note.count());
  call.next_note *= 2;
}

[[noreturn]] void lookOn(Watched& all) {
  while (true) {
    std::this_thread::sleep_for(kLook);
    const std::lock_guard lock(all.mutex);
    const auto now = Clock::now();
    for (WatchedCall& call : all.calls) look(call, now);
  }
}

}  // namespace

DriverWatch::DriverWatch(std::string what, Patience patience) {
  static const double chosen_s = chosenEnd_s();
  if (chosen_s > 0)
    patience.end = seconds(std::max<long long>(1, static_cast<long long>(std::min(chosen_s, 1e9))));
  Watched& all = watched();
  const std::lock_guard lock(all.mutex);
  call_ = all.calls.insert(all.calls.end(),
                           WatchedCall{std::move(what), patience, Clock::now(), patience.note});
  if (std::exchange(all.thread_of, getpid()) != getpid())
    std::thread([&all] { lookOn(all); }).detach();
}

DriverWatch::~DriverWatch() {
  Watched& all = watched();
  const std::lock_guard lock(all.mutex);
  all.calls.erase(call_);
}

}  // namespace glintmark
