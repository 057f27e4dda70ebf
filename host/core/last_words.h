// What a process leaves to the one that waits for it: that it ended by its own will, or else which
// call of an OpenCL driver it was in.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace glintmark {

/// Before a fork: this process hears the child's last words. False if there is no memory for it.
bool shareLastWords();
/// Before the next child.
void forgetLastWords();
/// There is no child after all: nobody hears this process.
void unshareLastWords();

/// This process is done and ends with `code`. May be called in a signal handler.
void leaveExitCode(int code);
/// The code that a child left; nothing if something else ended it.
std::optional<int> leftExitCode();
/// This process ends because a driver hangs: it "was `what`".
void leaveHang(std::string_view what);
/// What a child was in when it took the driver to hang; empty if it did not.
std::string leftHang();
/// Does a process wait for this one and its words?
bool hasHearer();
/// The innermost DriverCall that was alive when the child ended, empty if none was.
std::string callUnderWay();

/// Says so, writes what waits and ends the process, without the handlers that drivers may have
/// registered with atexit(): they crash and hang. Ours are those of at_quick_exit().
[[noreturn]] void endProcess(int code);

/// As long as it lives, this process is in a driver: "compiling shade.cl". On one thread.
class DriverCall {
 public:
  explicit DriverCall(std::string_view what);
  ~DriverCall();
  DriverCall(const DriverCall&) = delete;
  DriverCall& operator=(const DriverCall&) = delete;

 private:
  std::string before_;
};

}  // namespace glintmark
