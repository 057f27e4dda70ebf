#include "host/experiment/accuracy/scene_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "host/experiment/accuracy/equal_cost.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr std::size_t kScenesPerTable = 5;

// "cloth/near" of "ltc/area_cloth/near": area lights are what all of them have.
std::string sceneName(const SettingGroup& group) {
  const std::string name = CaseName::parse(group.name).rest().text();
  const std::string common = "area_";
  return name.starts_with(common) ? name.substr(common.size()) : name;
}

struct SceneColumn {
  const char* title;
  const char* metric;
};
constexpr SceneColumn kSceneColumns[] = {
    {"error", "error"}, {"bias", "bias"}, {"time over the default's", "time_ratio"}};

std::string sceneTableText(std::span<const Record> records, std::span<const SettingGroup> scenes,
                           const SceneColumn& column) {
  std::vector<std::string> header = {column.title};
  for (const SettingGroup& scene : scenes) header.push_back(sceneName(scene));
  TextTable table(header);
  for (const MeasuredSetting& setting : scenes.front().settings) {
    std::vector<std::string> row = {setting.name + (setting.role == kAccuracyDefault ? " *" : "")};
    for (const SettingGroup& scene : scenes)
      row.push_back(CaseRecords(records, scene.name + "/" + setting.name).text(column.metric));
    table.addRow(row);
  }
  return table.toString() + "\n";
}

// "mc_samples takes 34 (cloth/far) to 210 (cloth/near) times the default's time for its error."
std::string spreadText(std::span<const SettingGroup> scenes, const std::string& knob) {
  std::vector<std::pair<double, std::string>> times;
  std::size_t never = 0;
  for (const SettingGroup& scene : scenes) {
    const std::vector<EqualCost> costs = equalCosts(scene);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const MeasuredSetting& setting = scene.settings[i];
      if (setting.role != kAccuracySampled ||
          CaseName::parse(setting.name).knobs.front().name != knob)
        continue;
      if (costs[i].time_at_error)
        times.emplace_back(*costs[i].time_at_error, sceneName(scene));
      else
        ++never;
      break;  // the same for all numbers of samples
    }
  }
  if (times.empty()) return "";
  const auto [least, most] = std::ranges::minmax_element(times);
  return fmt::format(
      "For the default's error {} takes {} ({}) to {} ({}) times its time{}.\n", knob,
      compactNumber(least->first), least->second, compactNumber(most->first), most->second,
      never > 0 ? fmt::format(", and never comes as close in {} scenes", never) : "");
}

}  // namespace

std::string accuracySceneText(std::span<const Record> records, const std::string& effect) {
  std::vector<SettingGroup> scenes = settingGroups(records);
  std::erase_if(scenes, [&](const SettingGroup& group) {
    return group.isEffect() || CaseName::parse(group.name).word(0) != effect;
  });
  if (scenes.empty()) return "";
  std::string text = fmt::format("\n{} in each scene\n", effect);
  for (const SceneColumn& column : kSceneColumns)
    for (std::size_t begin = 0; begin < scenes.size(); begin += kScenesPerTable)
      text += sceneTableText(
          records,
          std::span(scenes).subspan(begin, std::min(kScenesPerTable, scenes.size() - begin)),
          column);
  std::set<std::string> knobs;
  for (const MeasuredSetting& setting : scenes.front().settings)
    if (setting.role == kAccuracySampled)
      knobs.insert(CaseName::parse(setting.name).knobs.front().name);
  for (const std::string& knob : knobs) text += spreadText(scenes, knob);
  return text;
}

}  // namespace glintmark
