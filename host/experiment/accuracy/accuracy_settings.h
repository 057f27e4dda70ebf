// Cases of table "accuracy" as settings that can be compared: an effect's over all its scenes, or
// in one scene.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/experiment/accuracy/pareto.h"
#include "host/report/record/record.h"

namespace glintmark {

/// Part that a case plays, in its records' configuration under "role".
inline constexpr const char* kAccuracyDefault = "default";
inline constexpr const char* kAccuracyKnob = "knob";
inline constexpr const char* kAccuracyRival = "rival";
/// A rival whose error falls with the number of its samples, the value of its knob.
inline constexpr const char* kAccuracySampled = "sampled";
/// Empty if the record says none.
std::string accuracyRole(const Record& record);

/// A case that has `error` and `time_ratio`.
struct MeasuredSetting {
  std::string case_name, name;  // "ltc/area_cloth/near/edges=acos", "edges=acos"
  std::string role;
  const Record* error = nullptr;
  double time_ratio = 1, time_noise = 0;  // the median's standard error, twice
  double truth_stderr = 0;
  double mean_square = 0;  // relMSE; the square of an error that has none
};

/// The settings that are compared with each other.
struct SettingGroup {
  std::string name;  // "ltc", or "ltc/area_cloth/near" of a single scene
  std::vector<MeasuredSetting> settings{};
  // Of the settings, as far as they can be told apart: times within two standard errors of their
  // median are the default's, errors below the truth's standard error are equal, both go in steps
  // of kAccuracyStep from the default's. A setting that is not valid has an error that is no
  // number.
  std::vector<CostAndError> points{};

  /// Of all scenes.
  bool isEffect() const { return name.find('/') == std::string::npos; }
  /// The first default; null if there is none.
  const MeasuredSetting* standard() const;
};
inline constexpr double kAccuracyStep = 0.05;

/// Groups in the order of the records, which must outlive them.
std::vector<SettingGroup> settingGroups(std::span<const Record> records);

}  // namespace glintmark
