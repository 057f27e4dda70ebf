#include "host/experiment/accuracy/accuracy_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "host/experiment/accuracy/accuracy_settings.h"
#include "host/experiment/accuracy/pareto.h"
#include "host/report/picture/line_chart.h"

namespace glintmark {
namespace {

constexpr double kMargin = 1.25;  // around the least and the greatest time

// Settings of one part, a dot each.
struct Part {
  const char *role, *name;
  int colour;
};
constexpr Part kParts[] = {{kAccuracyKnob, "one knob off the default", 2},
                           {kAccuracyRival, "rival", 3},
                           {kAccuracySampled, "sampled rival", 4},
                           {kAccuracyDefault, "default", 1}};

ChartSeries partOf(const SettingGroup& effect, const Part& part) {
  ChartSeries series{part.name, seriesColour(part.colour), {}, {}, true};
  for (const MeasuredSetting& setting : effect.settings) {
    if (setting.role != part.role) continue;
    series.x.push_back(setting.time_ratio);
    series.y.push_back(setting.error->value.median);
  }
  return series;
}

// The optimal settings by time, joined.
ChartSeries frontOf(const SettingGroup& effect) {
  const std::vector<bool> optimal = paretoOptimal(effect.points);
  std::vector<std::pair<double, double>> front;
  for (std::size_t i = 0; i < effect.settings.size(); ++i)
    if (optimal[i])
      front.emplace_back(effect.settings[i].time_ratio, effect.settings[i].error->value.median);
  std::ranges::sort(front);
  ChartSeries series{"optimal", seriesColour(0), {}, {}};
  for (const auto& [time, error] : front) {
    series.x.push_back(time);
    series.y.push_back(error);
  }
  return series;
}

// Below it errors are the truth's own.
ChartSeries noiseOf(const SettingGroup& effect, const ChartPanel& panel) {
  const double noise = effect.standard()->truth_stderr;
  return {
      "standard error of the truth", seriesColour(5), {panel.x_low, panel.x_high}, {noise, noise}};
}

ChartPanel panelOf(const SettingGroup& effect) {
  ChartPanel panel{effect.name, {}, 1, 1};
  for (const MeasuredSetting& setting : effect.settings) {
    panel.x_low = std::min(panel.x_low, setting.time_ratio);
    panel.x_high = std::max(panel.x_high, setting.time_ratio);
  }
  panel.x_low /= kMargin;
  panel.x_high *= kMargin;
  panel.series = {frontOf(effect), noiseOf(effect, panel)};
  for (const Part& part : kParts) panel.series.push_back(partOf(effect, part));
  std::erase_if(panel.series, [](const ChartSeries& series) {
    return series.x.size() < (series.dots ? 1u : 2u);  // nothing to be seen
  });
  return panel;
}

}  // namespace

void writeAccuracyCharts(std::span<const Record> records, const std::filesystem::path& folder) {
  const ChartOptions options{.columns = 1,
                             .panel_width_px = 640,
                             .panel_height_px = 400,
                             .scale = ChartScale::kLogarithmic,
                             .x_label = "time over the default's",
                             .y_label = "error"};
  for (const SettingGroup& effect : settingGroups(records)) {
    if (!effect.isEffect() || effect.standard() == nullptr || effect.settings.size() < 2) continue;
    writeChart({panelOf(effect)}, options, folder / fmt::format("accuracy_{}", effect.name));
  }
}

}  // namespace glintmark
