#include "host/experiment/accuracy/equal_cost.h"

#include <algorithm>
#include <cmath>

#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

// A slope of the logarithms flatter than this is none: an error that stays, or the truth's own.
constexpr double kLeastSlope = 0.1;

struct Segment {
  const SampledPoint &from, &to;

  // Of the logarithm of the error over that of the time.
  double slope() const { return std::log(to.error / from.error) / std::log(to.time / from.time); }
  bool falls() const { return to.time > from.time && slope() < -kLeastSlope; }
  double errorAt(double time) const { return from.error * std::pow(time / from.time, slope()); }
  double timeAt(double error) const {
    return from.time * std::pow(error / from.error, 1 / slope());
  }
};

// The segment of `curve` within or next to which `before` says a point lies.
template <typename Before>
Segment segmentAt(std::span<const SampledPoint> curve, const Before& before) {
  std::size_t end = 1;
  while (end + 1 < curve.size() && before(curve[end])) ++end;
  return {curve[end - 1], curve[end]};
}

// The numbers of samples of a setting's knob that can be told from the truth.
std::vector<SampledPoint> curveOf(const SettingGroup& group, const std::string& knob) {
  std::vector<SampledPoint> curve;
  for (const MeasuredSetting& setting : group.settings) {
    const CaseName name = CaseName::parse(setting.name);
    if (setting.role != kAccuracySampled || name.knobs.front().name != knob) continue;
    const double error = setting.error->value.median;
    if (setting.error->valid && error > setting.truth_stderr && setting.time_ratio > 0)
      curve.push_back({name.number(knob), setting.time_ratio, error});
  }
  std::ranges::sort(curve, {}, &SampledPoint::samples);
  return curve;
}

EqualCost sampledCost(const SettingGroup& group, const MeasuredSetting& setting,
                      double default_error) {
  const std::string knob = CaseName::parse(setting.name).knobs.front().name;
  const std::vector<SampledPoint> curve = curveOf(group, knob);
  EqualCost cost;
  cost.error_at_time = errorAtTime(curve, 1);
  cost.time_at_error = timeAtError(curve, default_error);
  cost.how = "by all numbers of samples of " + knob;
  if (cost.time_at_error && !curve.empty() && *cost.time_at_error > curve.back().time)
    cost.how += ", the time extrapolated";
  return cost;
}

}  // namespace

std::optional<double> errorAtTime(std::span<const SampledPoint> curve, double time) {
  if (curve.size() < 2) return {};
  if (curve.front().samples <= 1 && time < curve.front().time * (1 - kAccuracyStep)) return {};
  const Segment segment =
      segmentAt(curve, [&](const SampledPoint& point) { return point.time < time; });
  if (!segment.falls()) return {};
  return segment.errorAt(time);
}

std::optional<double> timeAtError(std::span<const SampledPoint> curve, double error) {
  if (curve.size() < 2 || !(error > 0)) return {};
  if (curve.front().samples <= 1 && curve.front().error <= error) return curve.front().time;
  const Segment segment =
      segmentAt(curve, [&](const SampledPoint& point) { return point.error > error; });
  if (!segment.falls()) return {};
  return segment.timeAt(error);
}

std::vector<EqualCost> equalCosts(const SettingGroup& group) {
  const MeasuredSetting* standard = group.standard();
  if (standard == nullptr) return {};
  const auto at = static_cast<std::size_t>(standard - group.settings.data());
  const CostAndError& anchor = group.points[at];
  std::vector<EqualCost> costs;
  for (std::size_t i = 0; i < group.settings.size(); ++i) {
    const MeasuredSetting& setting = group.settings[i];
    EqualCost cost;
    if (setting.error->valid && standard->error->valid) {
      if (setting.role == kAccuracySampled) {
        cost = sampledCost(group, setting,
                           std::max(standard->error->value.median, standard->truth_stderr));
      } else {
        cost.how = "its own, it has no other";
        if (group.points[i].cost <= anchor.cost) cost.error_at_time = setting.error->value.median;
        if (group.points[i].error <= anchor.error) cost.time_at_error = setting.time_ratio;
      }
      if (setting.mean_square > 0 && setting.time_ratio > 0)
        cost.efficiency = standard->mean_square / (setting.mean_square * setting.time_ratio);
    }
    costs.push_back(std::move(cost));
  }
  return costs;
}

}  // namespace glintmark
