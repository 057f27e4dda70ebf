// What settings do in the default's time, and what they take for the default's error.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/accuracy/accuracy_settings.h"

namespace glintmark {

/// One number of samples of a sampled rival.
struct SampledPoint {
  double samples = 0, time = 0, error = 0;
};

/// Error and time of a sampled rival along its measured points, which are in order of time. Between
/// two of them the logarithm of the error falls evenly with that of the time; beyond the last, and
/// before the first unless that is one sample, as steeply as between the two that are nearest.
/// Nothing for fewer than two points, for less than one sample, and where errors do not fall.
std::optional<double> errorAtTime(std::span<const SampledPoint> curve, double time);
std::optional<double> timeAtError(std::span<const SampledPoint> curve, double error);

/// A setting beside the default of its group. A setting that is not sampled has one time and one
/// error: what it does is its own error if it takes no longer than the default, and its own time if
/// it errs no more; nothing, never, otherwise.
struct EqualCost {
  std::optional<double> error_at_time;  // in the default's time
  std::optional<double> time_at_error;  // over the default's time, for the default's error
  std::optional<double> efficiency;     // 1 / (mean square error * time), over the default's
  std::string how;
};
/// Of every setting of a group, in their order; empty if the group has no default.
std::vector<EqualCost> equalCosts(const SettingGroup& group);

}  // namespace glintmark
