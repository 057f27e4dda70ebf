#include "host/verify/check_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "host/core/error.h"
#include "host/core/process_end.h"
#include "host/core/stopwatch.h"
#include "host/experiment/interrupt.h"
#include "host/verify/check_result_json.h"

namespace glintmark {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPollMs = 50;

// Messages are lines of JSON in both directions: the parent sends the index of a check, the child
// {"opened": description}, {"result": {...}} or {"error": message, "code": exit code}.
bool sendLine(int socket, const Json& json) {
  const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t n = send(socket, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  return true;
}

std::optional<std::string> takeLine(std::string& received) {
  const std::size_t end = received.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = received.substr(0, end);
  received.erase(0, end + 1);
  return line;
}

// Waits for bytes; false at the end of the stream.
bool receive(int socket, std::string& received) {
  char bytes[4096];
  ssize_t n = 0;
  do n = recv(socket, bytes, sizeof bytes, 0);
  while (n < 0 && errno == EINTR);
  if (n > 0) received.append(bytes, static_cast<std::size_t>(n));
  return n > 0;
}

void serve(const std::vector<Check>& checks, const CheckProcess::Open& open, int socket) {
  CheckProcess::Opened opened = open();
  sendLine(socket, {{"opened", opened.description}});
  std::string received;
  while (true) {
    std::optional<std::string> line;
    while (!(line = takeLine(received)))
      if (!receive(socket, received)) return;
    const CheckResult result = runCheck(checks.at(std::stoul(*line)), {opened.bench, opened.lanes});
    sendLine(socket, {{"result", checkResultJson(result)}});
  }
}

// The child's main; never returns. Ctrl-C and the end of a terminal reach it too, but it is the
// parent that ends it.
[[noreturn]] void runChild(const std::vector<Check>& checks, const CheckProcess::Open& open,
                           int socket, pid_t parent) {
  dieWithParent(parent, kExitCheckFailed);
  signal(SIGINT, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
  constexpr int kRequests[] = {SIGTERM};
  endByDefault(kRequests);
  try {
    serve(checks, open, socket);
  } catch (const Error& error) {
    sendLine(socket, {{"error", error.what()}, {"code", static_cast<int>(error.code())}});
  } catch (const std::exception& error) {
    sendLine(socket, {{"error", error.what()}, {"code", static_cast<int>(kExitCheckFailed)}});
  }
  std::fflush(nullptr);
  _exit(kExitDone);  // no destructors: what the parent made is the parent's
}

}  // namespace

// What came from the child, or how it was lost.
struct CheckProcess::Answer {
  Json message;
  std::string lost;
};

CheckProcess::CheckProcess(const std::vector<Check>& checks, const Open& open) : checks_(checks) {
  int sockets[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0)
    throw Error(fmt::format("cannot start a process for checks: {}", std::strerror(errno)));
  std::fflush(nullptr);  // or both would write what waits
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    close(sockets[0]);
    runChild(checks, open, sockets[1], parent);
  }
  close(sockets[1]);
  socket_ = sockets[0];
  if (pid_ < 0) {
    close(socket_);
    throw Error(fmt::format("cannot start a process for checks: {}", std::strerror(errno)));
  }
}

CheckProcess::~CheckProcess() {
  end();
}

void CheckProcess::end() {
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  awaitProcess(pid_);
  close(socket_);
  pid_ = -1;
}

CheckProcess::Answer CheckProcess::await(double timeout_s, const std::function<bool()>& stop) {
  const Stopwatch watch;
  while (true) {
    if (const auto line = takeLine(received_)) return {Json::parse(*line), ""};
    if (stop()) {
      end();
      throw Interrupted("interrupted");
    }
    if (watch.elapsedNs() * 1e-9 > timeout_s) {
      end();
      return {{}, fmt::format("gave no answer within {:g} s; --timeout changes that", timeout_s)};
    }
    pollfd waiting = {socket_, POLLIN, 0};
    if (poll(&waiting, 1, kPollMs) <= 0 || receive(socket_, received_)) continue;
    const int status = awaitProcess(pid_);
    close(socket_);
    pid_ = -1;
    return {{}, howItEnded(status)};
  }
}

std::string CheckProcess::awaitDevice(double timeout_s, const std::function<bool()>& stop) {
  const Answer answer = await(timeout_s, stop);
  if (!answer.lost.empty())
    throw DeviceError(fmt::format("the process that opened the OpenCL device {}", answer.lost));
  if (answer.message.contains("error"))
    throw Error(answer.message["error"], answer.message["code"].get<ExitCode>());
  return answer.message["opened"];
}

CheckResult CheckProcess::run(std::size_t check, double timeout_s,
                              const std::function<bool()>& stop) {
  const Stopwatch watch;
  sendLine(socket_, check);
  const Answer answer = await(timeout_s, stop);
  if (answer.message.contains("error"))
    throw Error(answer.message["error"], answer.message["code"].get<ExitCode>());
  if (answer.lost.empty()) return checkResultFromJson(answer.message["result"]);
  CheckResult result;
  result.name = checks_[check].name;
  result.measure = checks_[check].measure;
  result.verdict = Verdict::kFail;
  result.judged = false;
  result.worst = std::numeric_limits<double>::infinity();
  result.note = fmt::format("its process {}", answer.lost);
  result.seconds = watch.elapsedNs() * 1e-9;
  return result;
}

}  // namespace glintmark
