#include "host/core/last_words.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace glintmark {
namespace {

constexpr std::size_t kMostBytes = 256;
constexpr int kNotLeft = -1;

struct LastWords {
  std::atomic<int> exit_code = kNotLeft;
  char call[kMostBytes] = {}, hang[kMostBytes] = {};
};

// Null where nobody waits.
LastWords* shared = nullptr;

void keep(std::string_view text, char* kept) {
  const std::size_t size = std::min(text.size(), kMostBytes - 1);
  std::memcpy(kept, text.data(), size);
  kept[size] = '\0';
}

}  // namespace

bool shareLastWords() {
  if (shared != nullptr) return true;
  void* const page =
      mmap(nullptr, sizeof(LastWords), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) return false;
  shared = new (page) LastWords;
  return true;
}

void forgetLastWords() {
  if (shared == nullptr) return;
  shared->exit_code = kNotLeft;
  shared->call[0] = shared->hang[0] = '\0';
}

void unshareLastWords() {
  shared = nullptr;
}

void leaveExitCode(int code) {
  if (shared != nullptr) shared->exit_code = code;
}

std::optional<int> leftExitCode() {
  if (shared == nullptr || shared->exit_code == kNotLeft) return std::nullopt;
  return shared->exit_code.load();
}

void leaveHang(std::string_view what) {
  if (shared != nullptr) keep(what, shared->hang);
}

std::string leftHang() {
  return shared != nullptr ? shared->hang : "";
}

bool hasHearer() {
  return shared != nullptr;
}

std::string callUnderWay() {
  return shared != nullptr ? shared->call : "";
}

void endProcess(int code) {
  std::fflush(nullptr);
  leaveExitCode(code);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  std::exit(code);  // where leaks are looked for
#else
  std::quick_exit(code);
#endif
}

DriverCall::DriverCall(std::string_view what) {
  if (shared == nullptr) return;
  before_ = shared->call;
  keep(what, shared->call);
}

DriverCall::~DriverCall() {
  if (shared != nullptr) keep(before_, shared->call);
}

}  // namespace glintmark
