// Properties of the kernels that `glintmark verify` and the tests check, on one device and at one
// lane count.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "host/harness/kernel_bench.h"

namespace glintmark {

/// What a check found: the worst of its errors beside the most they may be.
class Finding {
 public:
  /// `bound` is the largest error that passes; 0 where nothing may differ.
  explicit Finding(double bound) : bound_(bound) {}
  /// A check that this device or width cannot run, and why.
  static Finding skipped(const std::string& reason);

  /// Takes one error into account; what is not a number counts as infinite.
  void add(double error);
  /// Takes into account what nine of ten errors stay below, each of a light that mirrors enough to
  /// be judged; fewer than `least` of them are a failure.
  void addMost(std::vector<double> errors, std::size_t least);
  /// A condition beside the errors. The first that does not hold is kept as the reason of failure.
  void require(bool holds, const std::string& what);

  bool passes() const { return worst_ <= bound_ && violated_.empty(); }
  bool isSkipped() const { return skipped_; }
  double worst() const { return worst_; }
  double bound() const { return bound_; }
  /// Why it was skipped, or the condition that does not hold; else empty.
  const std::string& note() const { return violated_; }

 private:
  double worst_ = 0, bound_ = 0;
  std::string violated_;
  bool skipped_ = false;
};

/// What a check runs on: a device with its programs, and the lane count to check.
struct CheckContext {
  KernelBench& bench;
  int lanes = 1;

  CheckContext withLanes(int other_lanes) const { return {bench, other_lanes}; }
};

struct Check {
  std::string name;     // "group/property"
  std::string measure;  // what is measured, a few words
  std::function<Finding(const CheckContext&)> run;
};

/// Every check, in the order of the table.
std::vector<Check> allChecks();

enum class Verdict { kPass, kFail, kSkipped };
/// "pass", "FAIL" or "skipped".
std::string verdictName(Verdict verdict);

struct CheckResult {
  std::string name, measure;
  Verdict verdict = Verdict::kPass;
  double worst = 0, bound = 0;
  std::string note;
  double seconds = 0;  // wall time, compiling included
  bool judged = true;  // false: it failed without a finding, by an Error or a lost process
};

/// Runs one check; an Error that it throws is a failure with its message as the note.
CheckResult runCheck(const Check& check, const CheckContext& context);

}  // namespace glintmark
