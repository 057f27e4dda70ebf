#include "host/experiment/accuracy/accuracy_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/experiment/accuracy/accuracy_page.h"
#include "host/experiment/accuracy/pareto.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

// One case: a setting of an effect.
struct Setting {
  std::string case_name, name;  // "glints/ka=16", "ka=16"
  const Record* error = nullptr;
  double time_ratio = 1, time_noise = 0;  // the median's standard error, twice
  double truth_stderr = 0;
  bool is_default = false;
};

struct Effect {
  std::string name;
  std::vector<Setting> settings;
  std::vector<CostAndError> points;  // of the settings, as far as they can be told apart
};

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
double shownError(const Setting& setting) {
  if (!setting.error->valid) return std::numeric_limits<double>::quiet_NaN();
  return std::max(setting.error->value.median, setting.truth_stderr);
}

// The settings as far as what was measured can tell them from the default and from each other.
std::vector<CostAndError> measuredPoints(std::span<const Setting> settings) {
  const auto standard = std::ranges::find(settings, true, &Setting::is_default);
  const Setting& anchor = standard == settings.end() ? settings.front() : *standard;
  std::vector<CostAndError> points;
  for (const Setting& setting : settings)
    points.push_back({inSteps(setting.time_ratio, anchor.time_ratio, setting.time_noise),
                      inSteps(shownError(setting), shownError(anchor))});
  return points;
}

// Effects in the order of the records, each with its settings.
std::vector<Effect> effectsOf(std::span<const Record> records) {
  std::vector<Effect> effects;
  for (const std::string& case_name : caseNames(records)) {
    const CaseRecords one(records, case_name);
    const Record *error = one.find("error"), *ratio = one.find("time_ratio");
    if (error == nullptr || ratio == nullptr) continue;
    const CaseName parts = CaseName::parse(case_name);
    const std::string& name = parts.word(0);
    if (effects.empty() || effects.back().name != name) effects.push_back({name, {}, {}});
    const Record* truth = one.find("truth_stderr");
    effects.back().settings.push_back({case_name, parts.rest().text(), error, ratio->value.median,
                                       2 * medianStandardError(ratio->value),
                                       truth == nullptr ? 0 : truth->value.median,
                                       accuracyRole(*error) == kAccuracyDefault});
  }
  for (Effect& effect : effects) effect.points = measuredPoints(effect.settings);
  return effects;
}

std::string timesText(double ratio) {
  return ratio < 10 ? fmt::format("{:.2f} times", ratio) : fmt::format("{:.0f} times", ratio);
}

// "takes 1.50 times the time for an error of 0.0123"
std::string stepText(const Setting& to) {
  return fmt::format("{}, takes {} its time for an error of {}", to.name, timesText(to.time_ratio),
                     compactNumber(to.error->value.median));
}

std::string sentence(const Effect& effect) {
  const auto found = std::ranges::find(effect.settings, true, &Setting::is_default);
  if (found == effect.settings.end()) return "";
  const auto at = static_cast<std::size_t>(found - effect.settings.begin());
  const auto fastest =
      static_cast<std::size_t>(std::ranges::min_element(effect.settings, {}, &Setting::time_ratio) -
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
std::vector<Column> columnsOf(std::span<const Record> records, const Effect& effect) {
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
    for (const Setting& setting : effect.settings) {
      const Record* record = CaseRecords(records, setting.case_name).find(column.metric);
      any = any || record != nullptr;
      another =
          another || (record != nullptr && record->value.median != setting.error->value.median);
    }
    if (any && another) columns.push_back(column);
  }
  return columns;
}

std::string effectText(std::span<const Record> records, const Effect& effect) {
  const std::vector<Column> columns = columnsOf(records, effect);
  std::vector<std::string> header = {effect.name};
  for (const Column& column : columns) header.push_back(column.name);
  TextTable table(header);
  const std::vector<bool> optimal = paretoOptimal(effect.points);
  for (std::size_t i = 0; i < effect.settings.size(); ++i) {
    const Setting& setting = effect.settings[i];
    const CaseRecords one(records, setting.case_name);
    const std::string role = accuracyRole(*setting.error);
    std::vector<std::string> row = {setting.name + (role == kAccuracyDefault ? " *"
                                                    : role == kAccuracyRival ? " (rival)"
                                                                             : "")};
    for (const Column& column : columns)
      row.push_back(column.metric == kOptimal ? (optimal[i] ? "yes" : "")
                                              : one.text(column.metric));
    table.addRow(row);
  }
  return table.toString() + wrapped(effect.settings.front().error->note) + "\n" +
         wrapped(sentence(effect)) + "\n";
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
           {"motion_swing", "1"}},
      .cost_ratios = {"time_ratio"},
      .headline = Headline{"pareto", "settings on the front of accuracy against time", true},
      .section = accuracyHtml,
  };
  return spec;
}

std::string accuracyRole(const Record& record) {
  const auto role = record.config.find("role");
  return role == record.config.end() ? "" : role->second;
}

std::string accuracySentence(std::span<const Record> records, const std::string& effect) {
  const std::vector<Effect> effects = effectsOf(records);
  const auto found = std::ranges::find(effects, effect, &Effect::name);
  return found == effects.end() ? "" : sentence(*found);
}

std::vector<Record> accuracyPareto(std::span<const Record> records) {
  std::vector<Record> made;
  for (const Effect& effect : effectsOf(records)) {
    const std::vector<bool> optimal = paretoOptimal(effect.points);
    for (std::size_t i = 0; i < effect.settings.size(); ++i) {
      Record record = *effect.settings[i].error;
      record.metric = "pareto";
      record.value = summarize(std::vector<double>{optimal[i] ? 1.0 : 0.0});
      record.note = record.valid ? "1: no other setting is both faster and closer" : record.note;
      made.push_back(std::move(record));
    }
  }
  return made;
}

std::string accuracyTableText(std::span<const Record> records) {
  std::string text;
  for (const Effect& effect : effectsOf(records))
    text += fmt::format("{}{}", text.empty() ? "" : "\n", effectText(records, effect));
  return text;
}

}  // namespace glintmark
