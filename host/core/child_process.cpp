#include "host/core/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "host/core/control_group.h"
#include "host/core/error.h"
#include "host/core/process_end.h"

namespace glintmark {
namespace {

void limitResource(int resource, double most) {
  rlimit limit = {};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
  const auto wanted = static_cast<rlim_t>(most);
  if (limit.rlim_max != RLIM_INFINITY && limit.rlim_max < wanted) return;
  limit.rlim_cur = wanted;
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

void limitMemory(std::uint64_t bytes) {
  const auto pages = readNumber("/proc/self/statm");
  if (pages)
    limitResource(RLIMIT_AS,
                  *pages * static_cast<double>(sysconf(_SC_PAGESIZE)) + static_cast<double>(bytes));
}

// Libraries print lines of their own beside the sentence that is made of what they return. What a
// sanitizer says stays.
void silence() {
#ifndef __SANITIZE_ADDRESS__
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
#endif
}

[[noreturn]] void runChild(const std::function<void(int channel)>& work, const ChildLimits& limits,
                           pid_t parent, int channel) {
  dieWithParent(parent, 1);
  constexpr int kRequests[] = {SIGINT, SIGTERM, SIGHUP};
  endByDefault(kRequests);
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
    signal(number, SIG_DFL);
  limitResource(RLIMIT_CORE, 0);
  silence();
  if (limits.cpu_s > 0) limitResource(RLIMIT_CPU, std::ceil(limits.cpu_s));
  if (limits.memory_bytes > 0) limitMemory(limits.memory_bytes);
  try {
    work(channel);
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

}  // namespace

ChildProcess::ChildProcess(const std::function<void(int channel)>& work, const ChildLimits& limits)
    : limits_(limits) {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(fmt::format("cannot make a channel to a process: {}", std::strerror(errno)));
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    close(ends[0]);
    runChild(work, limits, parent, ends[1]);
  }
  const int fork_error = errno;
  close(ends[1]);
  channel_ = ends[0];
  if (pid_ > 0) return;
  close(channel_);
  throw Error(fmt::format("cannot start a process: {}", std::strerror(fork_error)));
}

ChildProcess::~ChildProcess() {
  close(channel_);
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  awaitProcess(pid_);
}

bool ChildProcess::waitForFirst() {
  began_ = true;
  if (limits_.wall_s <= 0) return true;
  pollfd waiting = {channel_, POLLIN, 0};
  // Signals that this process handles may cut a wait short: then it begins anew.
  int ready = 0;
  do {
    ready = poll(&waiting, 1, static_cast<int>(std::min(limits_.wall_s, 1e6) * 1000));
  } while (ready < 0 && errno == EINTR);
  return ready != 0;
}

bool ChildProcess::write(const void* bytes, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t sent =
        send(channel_, static_cast<const char*>(bytes) + done, count - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    done += static_cast<std::size_t>(sent);
  }
  return true;
}

std::size_t ChildProcess::read(void* bytes, std::size_t count) {
  if (!began_ && !waitForFirst()) {
    late_ = true;
    kill(pid_, SIGKILL);
  }
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::read(channel_, static_cast<char*>(bytes) + done, count - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string ChildProcess::finish() {
  shutdown(channel_, SHUT_WR);
  const int status = awaitProcess(pid_);
  pid_ = -1;
  if (late_) return fmt::format("was not done after {:g} s", limits_.wall_s);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return fmt::format("was not done after {:g} s of computing", limits_.cpu_s);
  return status == 0 ? std::string() : (WIFSIGNALED(status) ? "was " : "") + howItEnded(status);
}

}  // namespace glintmark
