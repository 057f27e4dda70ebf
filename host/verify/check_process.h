// Checks in a process of their own, so that a driver that dies or hangs costs one of them.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/harness/kernel_bench.h"
#include "host/verify/check.h"

namespace glintmark {

/// A child of this process that opens the device and runs checks for it, one at a time. Needs a
/// process that has not used OpenCL itself and has one thread.
class CheckProcess {
 public:
  /// What the child opens, and words about it for the parent.
  struct Opened {
    KernelBench bench;
    int lanes = 1;
    std::string description;
  };
  using Open = std::function<Opened()>;

  /// Starts the child. Nothing is waited for.
  CheckProcess(const std::vector<Check>& checks, const Open& open);
  /// Kills the child if it runs.
  ~CheckProcess();
  CheckProcess(const CheckProcess&) = delete;
  CheckProcess& operator=(const CheckProcess&) = delete;

  /// Waits for the device and returns its description. `stop` is asked now and then; see run().
  /// Throws the child's Error, or DeviceError if it died or took longer than `timeout_s`.
  std::string awaitDevice(double timeout_s, const std::function<bool()>& stop);

  /// Runs one check, an index into the constructor's. A child that dies or takes longer than
  /// `timeout_s` makes it fail, and is gone. Where `stop` says so the child is killed and
  /// Interrupted thrown. Throws the child's DeviceError.
  CheckResult run(std::size_t check, double timeout_s, const std::function<bool()>& stop);

  bool isAlive() const { return pid_ > 0; }

 private:
  struct Answer;
  Answer await(double timeout_s, const std::function<bool()>& stop);
  void end();

  const std::vector<Check>& checks_;
  int pid_ = -1, socket_ = -1;
  std::string received_;
};

}  // namespace glintmark
