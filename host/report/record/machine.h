// What of the machine this process may use, and how busy it is.
#pragma once
#include <filesystem>

#include "host/report/record/record.h"

namespace glintmark {

/// Processors that this process can keep busy: those it may run on, and no more than the quotas of
/// its control groups (both versions) pay for. `root` stands for "/".
int usableCores(const std::filesystem::path& root = "/");

/// Load of the last minute and mean clock of the processors now; peaks are left for the caller.
MachineState machineState(const std::filesystem::path& root = "/");

/// Processor time of everybody since it was made.
class MachineWatch {
 public:
  explicit MachineWatch(std::filesystem::path root = "/");
  /// Processors that others kept busy on average, at least 0.
  double othersCores() const;
  /// Time that the control group's quota took from this process [s].
  double throttledSeconds() const;

 private:
  struct Times {
    double wall_s = 0, all_s = 0, own_s = 0, throttled_s = 0;
  };
  Times now() const;

  std::filesystem::path root_;
  Times start_;
};

/// Why the figures of this run are those of a busy machine, or nothing: peaks that moved by more
/// than a tenth between begin and end, others at work, or time taken by a quota.
std::string busyText(const RunInfo& run);

}  // namespace glintmark
