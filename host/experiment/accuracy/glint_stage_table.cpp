#include "host/experiment/accuracy/glint_stage_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/experiment/accuracy/accuracy_table.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

enum class Over { kGeometric, kMean, kMost };  // how stages are put together

struct StageColumn {
  const char* name;
  const char* metric;
  Over over;
};

constexpr StageColumn kFigures[] = {{"W1", "error", Over::kGeometric},
                                    {"s.e.", "truth_stderr", Over::kGeometric},
                                    {"lobes", "lobes_error", Over::kGeometric},
                                    {"tent", "tent_error", Over::kGeometric},
                                    {"mean-1", "bias", Over::kMean},
                                    {"variance", "variance_ratio", Over::kGeometric},
                                    {"dark", "dark_share", Over::kMean},
                                    {"(truth)", "truth_dark_share", Over::kMean},
                                    {"largest", "largest_of_bound", Over::kMost},
                                    {"corr.", "correlation", Over::kMean},
                                    {"motion", "motion_ratio", Over::kGeometric}};
constexpr StageColumn kSwings[] = {{"W1", "error_swing", Over::kMean},
                                   {"variance", "variance_swing", Over::kMean},
                                   {"dark", "dark_swing", Over::kMean},
                                   {"largest", "largest_swing", Over::kMean},
                                   {"correlation", "correlation_swing", Over::kMean},
                                   {"motion", "motion_swing", Over::kMean}};
constexpr StageColumn kGrowths[] = {{"change", "zoom_ratio", Over::kGeometric},
                                    {"swing", "zoom_swing", Over::kMean},
                                    {"octave", "octave_correlation", Over::kMean}};

// Of cases "glints/SETTING/aspect=…/lambda=…".
struct StageCase {
  std::string case_name, setting;  // "zk16"; the knob is not said again
  double aspect, lambda;
  bool near;
};

// Those that have a metric.
std::vector<StageCase> stageCases(std::span<const Record> records, const char* metric) {
  std::vector<StageCase> cases;
  for (const std::string& case_name : caseNames(records)) {
    const CaseName name = CaseName::parse(case_name);
    if (!name.value("lambda") || CaseRecords(records, case_name).find(metric) == nullptr) continue;
    cases.push_back({case_name, name.knobs[0].value, name.number("aspect"), name.number("lambda"),
                     name.value("micro").has_value()});
  }
  return cases;
}

std::optional<double> together(std::span<const Record> records, const std::vector<StageCase>& cases,
                               const StageColumn& column) {
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
  const double size = std::abs(*value);
  if (size < 0.00005) return "0";
  if (size >= 1e4) return fmt::format("{:.0e}", *value);  // what is so far off needs no digits
  return size < 0.1 ? fmt::format("{:.4f}", *value)
         : size < 1 ? fmt::format("{:.3f}", *value)
                    : compactNumber(*value);
}

// Cases that make one line.
struct Line {
  std::string pixels;
  std::vector<StageCase> cases;
};

// Of one setting: each lambda over all aspects, each aspect over all lambdas, pixels from near.
std::vector<Line> linesOf(const std::vector<StageCase>& cases) {
  std::vector<Line> lines;
  const auto add = [&](const std::string& pixels, const StageCase& one) {
    const auto found = std::ranges::find(lines, pixels, &Line::pixels);
    if (found != lines.end())
      found->cases.push_back(one);
    else
      lines.push_back({pixels, {one}});
  };
  for (const StageCase& one : cases)
    if (!one.near) add(fmt::format("n={}", one.lambda), one);
  for (const StageCase& one : cases)
    if (!one.near) add(fmt::format("1:{}", one.aspect), one);
  for (const StageCase& one : cases)
    if (one.near) add("near", one);
  return lines;
}

std::string tableOf(std::span<const Record> records, std::span<const StageColumn> columns) {
  const std::vector<StageCase> cases = stageCases(records, columns.front().metric);
  std::vector<std::string> header = {"glints", "pixels"}, settings;
  for (const StageColumn& column : columns) header.emplace_back(column.name);
  TextTable table(header);
  for (const StageCase& one : cases)
    if (std::ranges::find(settings, one.setting) == settings.end()) settings.push_back(one.setting);
  for (const std::string& setting : settings) {
    if (setting != settings.front()) table.addRule();
    std::vector<StageCase> own;
    std::ranges::copy_if(cases, std::back_inserter(own),
                         [&](const StageCase& one) { return one.setting == setting; });
    std::string name = setting;  // on the first line
    for (const Line& line : linesOf(own)) {
      std::vector<std::string> row = {std::exchange(name, ""), line.pixels};
      for (const StageColumn& column : columns)
        row.push_back(shortNumber(together(records, line.cases, column)));
      table.addRow(row);
    }
  }
  return table.toString();
}

// Empty for runs that did not measure it.
std::string growthText(std::span<const Record> records) {
  if (stageCases(records, kGrowths[0].metric).empty()) return "";
  return "\nHow pixels change while the camera moves away and their microdetails stay. change: "
         "where\n"
         "they grow by a 16th of an octave, over the truth's; swing: of that, from level to "
         "level.\n"
         "octave: correlation with the same twice as long and wide, 1/2 of microdetails that "
         "stay\n" +
         tableOf(records, kGrowths);
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
  if (figures.lobes_error)
    add("lobes_error", {*figures.lobes_error},
        "the same to microdetails that mirror by their lobes");
  if (figures.tent_error)
    add("tent_error", {*figures.tent_error}, "the same to pixels that are tents");
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
  add_replicates("motion_ratio", "motion_swing", figures.motion_ratio);
  add_replicates("zoom_ratio", "zoom_swing", figures.zoom_ratio);
  add_replicates("octave_correlation", nullptr, figures.octave_correlation);
  return records;
}

std::string glintStageText(std::span<const Record> records) {
  if (stageCases(records, "error").empty()) return "";
  return fmt::format(
      "\n{}"
      "n: microdetails that reflect in a pixel, on average; 1:a: the footprint's sides; each over "
      "all "
      "of\n"
      "the other. near: a tenth of a microdetail a pixel. W1: distance to the truth; s.e.: of two "
      "samples\n"
      "of it; lobes, tent: to a truth whose microdetails mirror by their lobes, not all or "
      "nothing, "
      "and to\n"
      "one whose pixels are tents. variance, motion (change per quarter of a pixel): over the "
      "truth's.\n"
      "dark: share of pixels below 1 % of the smooth lobe. largest: ratio to the smooth lobe over "
      "its\n"
      "bound 1/p. corr.: with the next pixel. Last: the truth's other forms, and one binomial a "
      "pixel.\n\n"
      "How much these move over a zoom by two, n kept: greatest less least of {} steps\n{}{}",
      tableOf(records, kFigures), kGlintZoomSteps, tableOf(records, kSwings), growthText(records));
}

}  // namespace glintmark
