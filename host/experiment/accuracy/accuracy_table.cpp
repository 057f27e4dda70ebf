#include "host/experiment/accuracy/accuracy_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host/experiment/accuracy/accuracy_effect.h"
#include "host/experiment/accuracy/accuracy_page.h"
#include "host/experiment/accuracy/equal_cost.h"
#include "host/experiment/accuracy/pareto.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

std::string timesText(double ratio) {
  return ratio < 10 ? fmt::format("{:.2f} times", ratio) : fmt::format("{:.0f} times", ratio);
}

// "takes 1.50 times the time for an error of 0.0123"
std::string stepText(const MeasuredSetting& to) {
  return fmt::format("{}, takes {} its time for an error of {}", to.name, timesText(to.time_ratio),
                     compactNumber(to.error->value.median));
}

std::string sentence(const SettingGroup& effect) {
  const MeasuredSetting* found = effect.standard();
  if (found == nullptr) return "";
  const auto at = static_cast<std::size_t>(found - effect.settings.data());
  const auto fastest = static_cast<std::size_t>(
      std::ranges::min_element(effect.settings, {}, &MeasuredSetting::time_ratio) -
      effect.settings.begin());
  std::string text = fmt::format("The default of {} has an error of {}", effect.name,
                                 compactNumber(found->error->value.median));
  if (effect.points[fastest].cost < effect.points[at].cost)
    text += fmt::format(" where the fastest setting, {}, has {} in {} of the time",
                        effect.settings[fastest].name,
                        compactNumber(effect.settings[fastest].error->value.median),
                        fmt::format("{:.0f} %", 100 * effect.settings[fastest].time_ratio));
  if (const auto better = cheapestDominating(effect.points, at))
    text += fmt::format("; it is beaten: {}", stepText(effect.settings[*better]));
  const ParetoSteps steps = paretoSteps(effect.points, at);
  text += steps.up ? fmt::format("; the next step up, {}", stepText(effect.settings[*steps.up]))
                   : "; no setting that takes longer is closer";
  text += steps.down
              ? fmt::format("; the next step down, {}", stepText(effect.settings[*steps.down]))
              : "; no optimal setting is faster";
  return text + ".";
}

// Breaks lines at blanks.
std::string wrapped(const std::string& text) {
  std::string result;
  std::size_t column = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t length = end - begin;
    if (column > 0 && column + 1 + length > kTableColumnsLimit) {
      result += '\n';
      column = 0;
    } else if (column > 0) {
      result += ' ';
      ++column;
    }
    result.append(text, begin, length);
    column += length;
    begin = end + 1;
  }
  return result;
}

struct Column {
  const char* name;
  std::string_view metric;
};
constexpr std::string_view kOptimal = "pareto";  // told from the points, not from a record

// All that the effect's records hold, but for the metric that is its error under another name.
std::vector<Column> columnsOf(std::span<const Record> records, const SettingGroup& effect) {
  constexpr Column kColumns[] = {{"time ratio", "time_ratio"},
                                 {"ms", "time_ms"},
                                 {"fit ratio", "fit_ratio"},
                                 {"error", "error"},
                                 {"s.e.", "truth_stderr"},
                                 {"optimal", kOptimal},
                                 {"bias", "bias"},
                                 {"relMSE", "rel_mse"},
                                 {"colour", "colour_error"},
                                 {"variance", "variance_ratio"},
                                 {"motion", "motion_ratio"}};
  std::vector<Column> columns;
  for (const Column& column : kColumns) {
    bool any = column.metric == kOptimal, another = column.metric == "error" || any;
    for (const MeasuredSetting& setting : effect.settings) {
      const Record* record = CaseRecords(records, setting.case_name).find(column.metric);
      any = any || record != nullptr;
      another =
          another || (record != nullptr && record->value.median != setting.error->value.median);
    }
    if (any && another) columns.push_back(column);
  }
  return columns;
}

std::string markedName(const MeasuredSetting& setting) {
  if (setting.role == kAccuracyDefault) return setting.name + " *";
  const bool rival = setting.role == kAccuracyRival || setting.role == kAccuracySampled;
  return setting.name + (rival ? " (rival)" : "");
}

std::string orNever(const std::optional<double>& value) {
  return value ? compactNumber(*value) : "never";
}

// Sampled rivals once, whatever the number of samples.
std::string equalText(const SettingGroup& effect) {
  const std::vector<EqualCost> costs = equalCosts(effect);
  if (costs.empty() || effect.settings.size() < 2) return "";
  TextTable table({"beside the default", "error in its time", "time for its error", "efficiency"});
  std::vector<std::string> sampled;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const MeasuredSetting& setting = effect.settings[i];
    std::string name = markedName(setting);
    if (setting.role == kAccuracyDefault && &setting != effect.standard()) continue;
    if (setting.role == kAccuracySampled) {
      name = knobOf(setting.name) + " (rival)";
      if (std::ranges::find(sampled, name) != sampled.end()) continue;
      sampled.push_back(name);
    }
    table.addRow({name, orNever(costs[i].error_at_time), orNever(costs[i].time_at_error),
                  costs[i].efficiency ? compactNumber(*costs[i].efficiency) : "-"});
  }
  return "\n" + table.toString();
}

std::string effectText(std::span<const Record> records, const SettingGroup& effect) {
  const std::vector<Column> columns = columnsOf(records, effect);
  std::vector<std::string> header = {effect.name};
  for (const Column& column : columns) header.push_back(column.name);
  TextTable table(header);
  const std::vector<bool> optimal = paretoOptimal(effect.points);
  for (std::size_t i = 0; i < effect.settings.size(); ++i) {
    const MeasuredSetting& setting = effect.settings[i];
    const CaseRecords one(records, setting.case_name);
    std::vector<std::string> row = {markedName(setting)};
    for (const Column& column : columns)
      row.push_back(column.metric == kOptimal ? (optimal[i] ? "yes" : "")
                                              : one.text(column.metric));
    table.addRow(row);
  }
  return table.toString() + wrapped(effect.settings.front().error->note) + "\n" +
         wrapped(sentence(effect)) + "\n" + equalText(effect);
}

}  // namespace

const TableSpec& accuracySpec() {
  static const TableSpec spec = {
      .name = "accuracy",
      .title = "What accuracy costs",
      .about =
          "Each knob's error against the time it takes, both axes logarithmic. A named setting "
          "is Pareto-optimal: nothing else is both faster and closer.",
      .metrics =
          {{"error", "1", "error",
            "the effect's principal metric, below; the note names it, the truth, its size and the "
            "scenes"},
           {"truth_stderr", "1", "standard error of the truth",
            "what the truth itself may be off, in the same metric"},
           {"time_ratio", "1", "time over the default's",
            "time over the default's, measured in turn; 1 for the default"},
           {"time_ms", "ms", "time",
            "kernel events of a frame at the command line's size; of simulations wall time"},
           {"fit_ratio", "1", "",
            "of knobs of a fit: its time over the default fit's, in turn, on the first scene"},
           {"pareto", "1", "",
            "1 if no setting of the effect is as good in both time and error and better in one. "
            "Times and errors go in steps of 5 % from the default's; times within two standard "
            "errors of their median are the default's, errors below `truth_stderr` are equal, and "
            "what is not `valid` neither wins nor beats. Not in `records.jsonl`: it follows from "
            "the "
            "rest"},
           {"error_at_default_time", "1", "",
            "`error` in the default's time: of a sampled rival along its measured numbers of "
            "samples, of others their own if they take no longer. A setting without the record "
            "never does. This and the next two are not in `records.jsonl`; scenes have them too"},
           {"time_at_default_error", "1", "",
            "time over the default's for the default's `error`, likewise: of a sampled rival along "
            "its curve, extrapolated as it falls last; of others their own if they err no more"},
           {"efficiency", "1", "",
            "1 / (mean squared error × time), over the default's; the mean squared error is "
            "`rel_mse`, of glints the square of `error`"},
           {"bias", "1", "bias of the mean",
            "relative bias of the mean, relative mean squared error, distance of display colours"},
           {"rel_mse", "1", "relMSE"},
           {"colour_error", "1", "colour error"},
           {"distribution_distance", "1", "distance of distributions",
            "glints of older runs: `error` against frames of method `exact`"},
           {"frame_to_frame_error", "1", "frame-to-frame error",
            "glints of older runs: colour error of the change from frame to frame, three frames a "
            "quarter of a pixel apart, against the change by method `exact`"},
           {"variance_ratio", "1", "variance of glints",
            "glints: variance of pixels over the truth's"},
           {"motion_ratio", "1", "change of glints",
            "glints: mean change per quarter of a pixel of motion over the truth's"},
           {"lobes_error", "1", "error to lobes",
            "`error` against microdetails that mirror the share that their lobe says, instead of "
            "all "
            "or nothing with that probability, and (`tent_error`) against pixels that are tents "
            "over "
            "twice their parallelogram. This and what follows: cases "
            "`glints/…/aspect=…/lambda=…` only"},
           {"tent_error", "1"},
           {"dark_share", "1", "dark pixels",
            "share of pixels below a hundredth of the smooth lobe, and of the truth's"},
           {"truth_dark_share", "1"},
           {"largest_of_bound", "1", "largest glint",
            "largest ratio to the smooth lobe over 1 / p, which one microdetail does not exceed; "
            "and "
            "the truth's"},
           {"truth_largest_of_bound", "1"},
           {"correlation", "1", "correlation of neighbours",
            "autocorrelation over one pixel, and the truth's"},
           {"truth_correlation", "1"},
           {"error_swing", "1", "",
            "how much `error`, `variance_ratio`, `dark_share`, `largest_of_bound`, `correlation` "
            "and "
            "`motion_ratio` move over a zoom by two in 16 steps: greatest less least"},
           {"variance_swing", "1"},
           {"dark_swing", "1"},
           {"largest_swing", "1"},
           {"correlation_swing", "1"},
           {"motion_swing", "1"},
           {"zoom_ratio", "1", "change of growing glints",
            "glints: mean change where pixels grow by a 16th of an octave, over the truth's, and "
            "how "
            "much that moves over a zoom by two"},
           {"zoom_swing", "1"},
           {"octave_correlation", "1", "coherence over an octave",
            "correlation of pixels with the same twice as long and wide; of microdetails that stay "
            "1/2"}},
      .cost_ratios = {"time_ratio"},
      .headline = Headline{"pareto", "settings on the front of accuracy against time", true},
      .pictures = {{.kind = PictureGroup::Kind::kHidden,
                    .pictures = {{"accuracy_glints.png", "Error of glints over time"},
                                 {"accuracy_ltc.png", "Error of area lights over time"},
                                 {"accuracy_gmm.png", "Error of mixtures of normals over time"},
                                 {"accuracy_msbrdf.png",
                                  "Error of multiple scattering over time"}}}},
      .section = accuracyHtml,
  };
  return spec;
}

std::string accuracySentence(std::span<const Record> records, const std::string& effect) {
  const std::vector<SettingGroup> groups = settingGroups(records);
  const auto found = std::ranges::find(groups, effect, &SettingGroup::name);
  return found == groups.end() ? "" : sentence(*found);
}

std::vector<Record> accuracyDerived(std::span<const Record> records) {
  std::vector<Record> made;
  const auto add = [&](const MeasuredSetting& setting, const char* metric, double value,
                       const std::string& note) {
    Record record = *setting.error;
    record.metric = metric;
    record.value = summarize(std::vector<double>{value});
    if (record.valid) record.note = note;
    made.push_back(std::move(record));
  };
  for (const SettingGroup& group : settingGroups(records)) {
    const std::vector<bool> optimal = paretoOptimal(group.points);
    const std::vector<EqualCost> costs = equalCosts(group);
    for (std::size_t i = 0; i < group.settings.size(); ++i) {
      const MeasuredSetting& setting = group.settings[i];
      if (group.isEffect())
        add(setting, "pareto", optimal[i] ? 1.0 : 0.0,
            "1: no other setting is both faster and closer");
      if (costs.empty()) continue;
      const EqualCost& cost = costs[i];
      if (cost.error_at_time) add(setting, "error_at_default_time", *cost.error_at_time, cost.how);
      if (cost.time_at_error) add(setting, "time_at_default_error", *cost.time_at_error, cost.how);
      if (cost.efficiency) add(setting, "efficiency", *cost.efficiency, "over the default's");
    }
  }
  return made;
}

std::string accuracyTableText(std::span<const Record> records) {
  std::string text;
  for (const SettingGroup& group : settingGroups(records))
    if (group.isEffect())
      text += fmt::format("{}{}", text.empty() ? "" : "\n", effectText(records, group));
  return text;
}

}  // namespace glintmark
