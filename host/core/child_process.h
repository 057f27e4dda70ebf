// Work in a process of its own, for libraries that bad input makes crash.
#pragma once
#include <sys/types.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace glintmark {

/// What a child may take: 0 is no limit.
struct ChildLimits {
  double cpu_s = 0;
  double wall_s = 0;               // until its first byte
  std::uint64_t memory_bytes = 0;  // of address space, beyond what this process has
};

/// A forked copy of this process that does one piece of work and hands bytes back. It has the
/// thread that called alone, dies with it, leaves no core and gets its signals as if nobody had
/// caught them; what it prints on stderr is dropped. `work` reads and writes the descriptor that it
/// gets; what it throws ends the child.
class ChildProcess {
 public:
  /// Throws Error if the system gives no process.
  ChildProcess(const std::function<void(int channel)>& work, const ChildLimits& limits);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Hands bytes to the child; false if it has ended.
  bool write(const void* bytes, std::size_t count);
  /// Up to `count` bytes of what the child writes; fewer only if it ended.
  std::size_t read(void* bytes, std::size_t count);
  /// Hands nothing more over and waits for its end. Empty, or how it ended if that was not by its
  /// own will: "was ended by signal 11 (Segmentation fault)", "was not done after 20 s".
  std::string finish();

 private:
  /// Whether the first byte came in time.
  bool waitForFirst();

  ChildLimits limits_;
  pid_t pid_ = -1;
  int channel_ = -1;
  bool began_ = false, late_ = false;
};

}  // namespace glintmark
