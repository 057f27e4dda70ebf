#include "host/core/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace glintmark {
namespace {

constexpr std::size_t kMaxLineLength = 79;
bool all_are_silent = false;

// A wrapped line could not be overwritten.
std::size_t lineLength() {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return kMaxLineLength;
  return std::min<std::size_t>(kMaxLineLength, size.ws_col - 1u);
}

}  // namespace

Progress::Progress(bool quiet) : active_(!quiet && !all_are_silent && isatty(STDERR_FILENO) == 1) {}

void Progress::silenceAll() {
  all_are_silent = true;
}

bool Progress::areSilent() {
  return all_are_silent;
}

Progress::~Progress() {
  clear();
}

void Progress::show(int done, int total, const std::string& what) {
  if (!active_) return;
  std::string line = total > 0 ? fmt::format("[{}/{}] {}", done, total, what) : what;
  line.resize(std::min(line.size(), lineLength()));
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace glintmark
