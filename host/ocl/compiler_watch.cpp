#include "host/ocl/compiler_watch.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <utility>

#include "host/core/progress.h"

namespace glintmark {
namespace {

constexpr std::chrono::seconds kFirstNote{10};

}  // namespace

CompilerWatch::CompilerWatch(std::string what) : what_(std::move(what)) {
  if (!Progress::areSilent()) thread_ = std::thread([this] { watch(); });
}

CompilerWatch::~CompilerWatch() {
  {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void CompilerWatch::watch() {
  const auto begin = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  for (auto after = kFirstNote;; after *= 2) {
    if (ended_.wait_until(lock, begin + after, [&] { return has_ended_; })) return;
    fmt::print(stderr, "note: the driver has been compiling {} for {} s and is not done\n", what_,
               after.count());
  }
}

}  // namespace glintmark
