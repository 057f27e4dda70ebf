#include "host/ocl/driver_watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "host/core/error.h"
#include "host/core/last_words.h"
#include "host/core/progress.h"

namespace glintmark {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr std::chrono::milliseconds kLook{200}, kMostBetweenLooks{1000};

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

// Nothing if the variable is not there. Throws Error if it is no number of seconds above 0.
std::optional<double> chosenEnd_s() {
  const char* text = std::getenv("GLINTMARK_DRIVER_S");
  if (!text || !*text) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (*end != '\0' || !(value > 0))
    throw Error(fmt::format("GLINTMARK_DRIVER_S is '{}', expected seconds above 0", text));
  return value;
}

void endHung(const WatchedCall& call) {
  const std::string what =
      fmt::format("{} and gave no answer within {} s; GLINTMARK_DRIVER_S sets other seconds",
                  call.what, call.patience.end.count());
  leaveHang(what);
  if (!hasHearer()) fmt::print(stderr, "glintmark: the OpenCL driver was {}\n", what);
  _exit(kExitNoDevice);
}

void look(WatchedCall& call, Clock::duration since_last_look) {
  call.took += since_last_look;
  if (call.took >= call.patience.end) endHung(call);
  if (call.took < call.next_note) return;
  if (!Progress::areSilent())
    fmt::print(stderr, "note: the driver has been {} for {} s and is not done\n", call.what,
               call.next_note.count());
  call.next_note *= 2;
}

[[noreturn]] void lookOn(Watched& all) {
  for (Clock::time_point last = Clock::now();;) {
    std::this_thread::sleep_for(kLook);
    const std::lock_guard lock(all.mutex);
    const auto now = Clock::now();
    // A process that was stopped does not await anything meanwhile.
    const auto step = std::min<Clock::duration>(now - last, kMostBetweenLooks);
    last = now;
    for (WatchedCall& call : all.calls) look(call, step);
  }
}

}  // namespace

DriverWatch::DriverWatch(std::string what, Patience patience) {
  static const std::optional<double> chosen_s = chosenEnd_s();
  if (chosen_s)
    patience.end =
        seconds(std::max<long long>(1, static_cast<long long>(std::min(*chosen_s, 1e9))));
  Watched& all = watched();
  const std::lock_guard lock(all.mutex);
  call_ = all.calls.insert(all.calls.end(), WatchedCall{std::move(what), patience, patience.note});
  if (std::exchange(all.thread_of, getpid()) != getpid())
    std::thread([&all] { lookOn(all); }).detach();
}

DriverWatch::~DriverWatch() {
  Watched& all = watched();
  const std::lock_guard lock(all.mutex);
  all.calls.erase(call_);
}

}  // namespace glintmark
