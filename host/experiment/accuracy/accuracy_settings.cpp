#include "host/experiment/accuracy/accuracy_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"

namespace glintmark {
namespace {

// `value` in steps of kAccuracyStep from `anchor`; less than a step off, or than `noise`, is no
// difference.
double inSteps(double value, double anchor, double noise = 0) {
  if (!(value > 0 && anchor > 0)) return value;
  const double steps = std::log(value / anchor) / kAccuracyStep;
  return std::abs(steps) < 1 || std::abs(value - anchor) < noise
             ? anchor
             : anchor * std::exp(std::round(steps) * kAccuracyStep);
}

// Not a number if the measurement is not valid: such a setting is neither better nor worse.
double shownError(const MeasuredSetting& setting) {
  if (!setting.error->valid) return std::numeric_limits<double>::quiet_NaN();
  return std::max(setting.error->value.median, setting.truth_stderr);
}

std::vector<CostAndError> measuredPoints(const SettingGroup& group) {
  const MeasuredSetting* standard = group.standard();
  const MeasuredSetting& anchor = standard == nullptr ? group.settings.front() : *standard;
  std::vector<CostAndError> points;
  for (const MeasuredSetting& setting : group.settings)
    points.push_back({inSteps(setting.time_ratio, anchor.time_ratio, setting.time_noise),
                      inSteps(shownError(setting), shownError(anchor))});
  return points;
}

}  // namespace

std::string accuracyRole(const Record& record) {
  const auto role = record.config.find("role");
  return role == record.config.end() ? "" : role->second;
}

const MeasuredSetting* SettingGroup::standard() const {
  const auto found = std::ranges::find(settings, kAccuracyDefault, &MeasuredSetting::role);
  return found == settings.end() ? nullptr : &*found;
}

std::vector<SettingGroup> settingGroups(std::span<const Record> records) {
  std::vector<SettingGroup> groups;
  for (const std::string& case_name : caseNames(records)) {
    const CaseRecords one(records, case_name);
    const Record *error = one.find("error"), *ratio = one.find("time_ratio");
    if (error == nullptr || ratio == nullptr) continue;
    const CaseName parts = CaseName::parse(case_name);
    const std::string name = CaseName{parts.words}.text();
    auto group = std::ranges::find(groups, name, &SettingGroup::name);
    if (group == groups.end()) group = groups.insert(group, SettingGroup{name});
    const Record *truth = one.find("truth_stderr"), *squares = one.find("rel_mse");
    group->settings.push_back(
        {case_name, CaseName{{}, parts.knobs}.text(), accuracyRole(*error), error,
         ratio->value.median, 2 * medianStandardError(ratio->value),
         truth == nullptr ? 0 : truth->value.median,
         squares == nullptr ? std::pow(error->value.median, 2) : squares->value.median});
  }
  for (SettingGroup& group : groups) group.points = measuredPoints(group);
  return groups;
}

}  // namespace glintmark
