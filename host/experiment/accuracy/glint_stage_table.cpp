#include "host/experiment/accuracy/glint_stage_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/experiment/accuracy/accuracy_table.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

enum class Over { kGeometric, kMean, kMost };  // how stages are put together

struct Column {
  const char* name;
  const char* metric;
  Over over;
};

constexpr Column kFigures[] = {{"W1", "error", Over::kGeometric},
                               {"s.e.", "truth_stderr", Over::kGeometric},
                               {"lobes", "lobes_error", Over::kGeometric},
                               {"bias", "bias", Over::kMean},
                               {"variance", "variance_ratio", Over::kGeometric},
                               {"dark", "dark_share", Over::kMean},
                               {"(truth)", "truth_dark_share", Over::kMean},
                               {"largest", "largest_of_bound", Over::kMost},
                               {"(truth)", "truth_largest_of_bound", Over::kMost},
                               {"corr.", "correlation", Over::kMean},
                               {"motion", "motion_ratio", Over::kGeometric}};
constexpr Column kSwings[] = {{"W1", "error_swing", Over::kMean},
                              {"variance", "variance_swing", Over::kMean},
                              {"dark", "dark_swing", Over::kMean},
                              {"largest", "largest_swing", Over::kMean},
                              {"correlation", "correlation_swing", Over::kMean},
                              {"motion", "motion_swing", Over::kMean}};

// Of cases "glints/SETTING/aspect=…/lambda=…".
struct StageCase {
  std::string case_name, setting;  // "zk16"; the knob is not said again
  double aspect, lambda;
};

// Those that have a metric.
std::vector<StageCase> stageCases(std::span<const Record> records, const char* metric) {
  std::vector<StageCase> cases;
  for (const std::string& case_name : caseNames(records)) {
    const CaseName name = CaseName::parse(case_name);
    if (!name.value("lambda") || CaseRecords(records, case_name).find(metric) == nullptr) continue;
    cases.push_back({case_name, name.knobs[0].value, name.number("aspect"), name.number("lambda")});
  }
  return cases;
}

std::optional<double> together(std::span<const Record> records, const std::vector<StageCase>& cases,
                               const Column& column) {
  std::vector<double> values;
  for (const StageCase& one : cases) {
    const Record* record = CaseRecords(records, one.case_name).find(column.metric);
    if (record == nullptr) return {};
    values.push_back(record->value.median);
  }
  if (column.over == Over::kGeometric) return geometricMeanOf(values);
  if (column.over == Over::kMost) return *std::ranges::max_element(values);
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::string shortNumber(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return "-";
  // Below the noise of any figure here: no long row of digits.
  return std::abs(*value) < 0.0005 ? "0" : compactNumber(*value);
}

// One line for each lambda, over all aspects, then for each aspect, over all lambdas.
std::string tableOf(std::span<const Record> records, std::span<const Column> columns) {
  const std::vector<StageCase> cases = stageCases(records, columns.front().metric);
  std::vector<std::string> header = {"glints", "pixels"};
  for (const Column& column : columns) header.emplace_back(column.name);
  TextTable table(header);
  std::vector<std::string> settings;
  for (const StageCase& one : cases)
    if (std::ranges::find(settings, one.setting) == settings.end()) settings.push_back(one.setting);
  for (const std::string& setting : settings) {
    if (setting != settings.front()) table.addRule();
    bool named = false;
    for (const auto member : {&StageCase::lambda, &StageCase::aspect}) {
      std::vector<double> values;
      for (const StageCase& one : cases)
        if (one.setting == setting) values.push_back(one.*member);
      std::ranges::sort(values);
      values.erase(std::unique(values.begin(), values.end()), values.end());
      for (const double value : values) {
        std::vector<StageCase> chosen;
        std::ranges::copy_if(cases, std::back_inserter(chosen), [&](const StageCase& one) {
          return one.setting == setting && one.*member == value;
        });
        const bool is_lambda = member == &StageCase::lambda;
        std::vector<std::string> row = {named ? "" : setting,
                                        fmt::format("{}{}", is_lambda ? "n=" : "1:", value)};
        named = true;
        for (const Column& column : columns)
          row.push_back(shortNumber(together(records, chosen, column)));
        table.addRow(row);
      }
    }
  }
  return table.toString();
}

}  // namespace

std::vector<Record> glintStageRecords(const BenchRun& run, const std::string& case_name,
                                      const std::string& role, const GlintFigures& figures) {
  std::vector<Record> records;
  const auto add = [&](const char* metric, const std::vector<double>& samples,
                       const std::string& note = "") {
    records.push_back(run.record(accuracySpec(), case_name, metric, samples, note));
    records.back().config["role"] = role;
    if (figures.sane) return;
    records.back().valid = false;
    records.back().note = "not valid: a ratio is negative or not finite";
  };
  const auto add_replicates = [&](const char* metric, const char* swing,
                                  const ReplicatedFigure& figure) {
    if (figure.replicates.empty()) return;
    add(metric, figure.replicates, "by replicate");
    if (swing != nullptr && figures.zooms) add(swing, {figure.swing});
  };
  add("error", {figures.error}, "Wasserstein distance to placed microdetails, over the mean");
  add("truth_stderr", {figures.noise}, "the same of two samples of the truth");
  add("lobes_error", {figures.lobes_error}, "the same to microdetails that mirror by their lobes");
  if (figures.zooms) add("error_swing", {figures.error_swing});
  if (!figures.mean.replicates.empty()) {
    ReplicatedFigure bias = figures.mean;
    for (double& mean : bias.replicates) mean -= 1;
    add_replicates("bias", nullptr, bias);
  }
  add_replicates("variance_ratio", "variance_swing", figures.variance_ratio);
  add_replicates("dark_share", "dark_swing", figures.dark);
  add("truth_dark_share", {figures.truth_dark});
  if (!figures.largest.replicates.empty()) {
    add("largest_of_bound", {*std::ranges::max_element(figures.largest.replicates)});
    if (figures.zooms) add("largest_swing", {figures.largest.swing});
  }
  add("truth_largest_of_bound", {figures.truth_largest});
  add_replicates("correlation", "correlation_swing", figures.correlation);
  add("truth_correlation", {figures.truth_correlation});
  if (figures.moves) add_replicates("motion_ratio", "motion_swing", figures.motion_ratio);
  return records;
}

std::string glintStageText(std::span<const Record> records) {
  if (stageCases(records, "error").empty()) return "";
  return fmt::format(
      "\n{}"
      "n: microdetails that reflect in a pixel, on average; 1:a: the footprint's sides; each over "
      "all "
      "of the\n"
      "other. s.e.: W1 of two samples of the truth. lobes: W1 where microdetails mirror by their "
      "lobes, not\n"
      "all or nothing. variance, motion (change per quarter of a pixel): over the truth's. dark: "
      "share of\n"
      "pixels below 1 % of the smooth lobe. largest: ratio to the smooth lobe over its bound 1/p. "
      "corr.:\n"
      "with the next pixel. lobes, tent, binomial: other forms of the truth.\n\n"
      "How much these move over a zoom by two, n kept: greatest less least of {} steps\n{}",
      tableOf(records, kFigures), kGlintZoomSteps, tableOf(records, kSwings));
}

}  // namespace glintmark
