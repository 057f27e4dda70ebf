// Settings of `accuracy` that come from the table of switches.
#pragma once
#include <string_view>
#include <vector>

#include "host/experiment/accuracy/accuracy_sweep.h"

namespace glintmark {

/// The settings of all switches that `accuracy` turns for an effect, in the order of the table, its
/// rivals behind its knobs: what host/ocl/switches.inc calls knob(effect, ...) and rivals().
class KnobSettings {
 public:
  explicit KnobSettings(std::string_view effect);

  /// Moves those of some knobs to the end of `all`: for an order other than the table's. Throws
  /// Error if the table has no such knob.
  void moveTo(std::vector<AccuracySetting>& all, std::initializer_list<std::string_view> knobs);
  /// Moves what is left.
  void moveRestTo(std::vector<AccuracySetting>& all);

 private:
  std::vector<AccuracySetting> settings_;
};

}  // namespace glintmark
