#include "host/report/record/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

enum class Direction { kLowerIsBetter, kHigherIsBetter, kNeither };

bool isTime(const Record& record) {
  return record.unit == "ms" || record.unit == "ns" || record.unit == "s";
}

bool isCostRatio(std::span<const TableSpec> tables, const Record& record) {
  const auto table = std::ranges::find(tables, record.table, &TableSpec::name);
  return table != tables.end() && std::ranges::count(table->cost_ratios, record.metric) > 0;
}

Direction directionOf(std::span<const TableSpec> tables, const Record& record) {
  const std::string& metric = record.metric;
  const auto has = [&](const char* part) { return metric.find(part) != std::string::npos; };
  if (metric.ends_with("per_s") || metric == "fps" || metric.starts_with("speedup"))
    return Direction::kHigherIsBetter;
  if (isTime(record) || record.unit == "bytes" || record.unit == "instructions" || has("cost") ||
      has("error") || has("bias") || metric == "rel_mse" || isCostRatio(tables, record))
    return Direction::kLowerIsBetter;
  return Direction::kNeither;
}

using Key = std::tuple<std::string, std::string, std::string, std::map<std::string, std::string>>;

Key keyOf(const Record& record) {
  std::map<std::string, std::string> config = record.config;
  config.erase("kernels");
  for (const char* how : {"reps", "timer", "noise", "max_time_s", "warmup", "width"})
    config.erase(how);
  return {record.table, record.case_, record.metric, std::move(config)};
}

// Two-sided p-value of "both medians are the same"; nothing if a spread is not known, both are 0,
// or something is not finite.
std::optional<double> welchOnMedians(const Summary& a, const Summary& b) {
  if (a.n < 2 || b.n < 2) return std::nullopt;
  const double va = std::pow(medianStandardError(a), 2), vb = std::pow(medianStandardError(b), 2);
  if (!(va + vb > 0)) return std::nullopt;
  const double t = std::abs(a.median - b.median) / std::sqrt(va + vb);
  // Welch-Satterthwaite.
  const double freedom =
      (va + vb) * (va + vb) /
      (va * va / static_cast<double>(a.n - 1) + vb * vb / static_cast<double>(b.n - 1));
  if (!std::isfinite(t) || !std::isfinite(freedom) || freedom <= 0) return std::nullopt;
  return 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), t));
}

Change judge(std::span<const TableSpec> tables, const Record& before, const Record& after,
             std::optional<double> p_value, double threshold) {
  const double a = before.value.median, b = after.value.median;
  if (a == b || (std::isnan(a) && std::isnan(b))) return Change::kSame;
  if (std::abs(b - a) <= threshold * std::max(std::abs(a), std::abs(b))) return Change::kSame;
  if (p_value && *p_value > kChangeLevel) return Change::kNoise;
  if (!p_value && (isTime(before) || before.value.n != after.value.n)) return Change::kUndecided;
  switch (directionOf(tables, after)) {
    case Direction::kNeither:
      return Change::kDifferent;
    case Direction::kLowerIsBetter:
      return std::abs(b) < std::abs(a) ? Change::kBetter : Change::kWorse;
    case Direction::kHigherIsBetter:
      return b > a ? Change::kBetter : Change::kWorse;
  }
  return Change::kDifferent;
}

// Does a busy machine make this figure worse? What is counted, and how far results are off, it
// cannot change.
bool dependsOnTheMachine(const Record& record) {
  const auto has = [&](const char* part) { return record.metric.find(part) != std::string::npos; };
  return record.unit != "bytes" && record.unit != "instructions" && !has("error") && !has("bias") &&
         record.metric != "rel_mse";
}

std::string busySentence(const char* which, const std::string& why) {
  return why.empty() ? "" : fmt::format("The machine of the {} run was busy: {}.\n", which, why);
}

std::size_t countOf(const ComparisonReport& report, Change change) {
  return static_cast<std::size_t>(
      std::ranges::count(report.comparisons, change, &Comparison::change));
}

std::string percentText(const Comparison& c) {
  if (c.old_value == 0) return "-";
  return fmt::format("{:+.1f}%", 100 * (c.new_value / c.old_value - 1));
}

bool isShown(const Comparison& c, bool all) {
  return all || (c.change != Change::kSame && c.change != Change::kNoise);
}

}  // namespace

std::string changeName(Change change) {
  switch (change) {
    case Change::kSame:
      return "same";
    case Change::kNoise:
      return "noise";
    case Change::kBetter:
      return "better";
    case Change::kWorse:
      return "WORSE";
    case Change::kDifferent:
      return "different";
    case Change::kBusy:
      return "busy";
    case Change::kUndecided:
      return "undecided";
  }
  return "?";
}

bool ComparisonReport::hasRegression() const {
  return !newly_invalid.empty() || countOf(*this, Change::kWorse) > 0;
}

ComparisonReport compareResults(const Results& old_results, const Results& new_results,
                                std::span<const TableSpec> tables, double threshold) {
  std::map<Key, const Record*> before;
  for (const Record& record : old_results.records) before[keyOf(record)] = &record;
  ComparisonReport report;
  report.old_busy = old_results.run.busy;
  report.new_busy = new_results.run.busy;
  std::size_t partners = 0;
  for (const Record& after : new_results.records) {
    const auto found = before.find(keyOf(after));
    if (found == before.end()) {
      ++report.only_new;
      continue;
    }
    ++partners;
    const Record& old_record = *found->second;
    if (old_record.valid && !after.valid)
      report.newly_invalid.push_back(
          fmt::format("{} {} {}", after.table, after.case_, after.metric));
    Comparison c{.table = after.table,
                 .case_ = after.case_,
                 .metric = after.metric,
                 .unit = after.unit,
                 .old_value = old_record.value.median,
                 .new_value = after.value.median,
                 .old_index = static_cast<std::size_t>(found->second - old_results.records.data())};
    c.p_value = welchOnMedians(old_record.value, after.value);
    c.change = judge(tables, old_record, after, c.p_value, threshold);
    const bool busy = !report.old_busy.empty() || !report.new_busy.empty();
    if (c.change == Change::kWorse && busy && dependsOnTheMachine(after)) c.change = Change::kBusy;
    const bool timed = !old_record.timer.empty() && !after.timer.empty();
    if (timed && old_record.timer != after.timer) ++report.other_timers;
    report.comparisons.push_back(std::move(c));
  }
  report.only_old = before.size() - std::min(before.size(), partners);
  return report;
}

std::string comparisonText(const ComparisonReport& report, bool all) {
  TextTable table({"case", "metric", "old", "new", "change", "p", "verdict"});
  bool any = false;
  for (const Comparison& c : report.comparisons) {
    if (!isShown(c, all)) continue;
    any = true;
    table.addRow({c.table + " " + c.case_, c.metric, compactNumber(c.old_value),
                  compactNumber(c.new_value), percentText(c),
                  c.p_value ? fmt::format("{:.1g}", *c.p_value) : "-", changeName(c.change)});
  }
  std::string text = any ? table.toString() + "\n" : "";
  text += fmt::format(
      "{} figures compared: {} same, {} within noise, {} better, {} worse, {} different, {} busy, "
      "{} undecided.\n",
      report.comparisons.size(), countOf(report, Change::kSame), countOf(report, Change::kNoise),
      countOf(report, Change::kBetter), countOf(report, Change::kWorse),
      countOf(report, Change::kDifferent), countOf(report, Change::kBusy),
      countOf(report, Change::kUndecided));
  text += busySentence("old", report.old_busy) + busySentence("new", report.new_busy);
  if (report.other_timers > 0)
    text += fmt::format("{} figures were timed by another clock in the old run.\n",
                        report.other_timers);
  if (report.only_old + report.only_new > 0)
    text += fmt::format("{} figures are only in the old file, {} only in the new one.\n",
                        report.only_old, report.only_new);
  for (const std::string& name : report.newly_invalid)
    text += fmt::format("{} was valid and is not any more.\n", name);
  return text;
}

std::string comparisonJson(const ComparisonReport& report, double threshold) {
  nlohmann::ordered_json json = {{"schema", "glintmark.comparison/1"},
                                 {"threshold", threshold},
                                 {"level", kChangeLevel},
                                 {"regression", report.hasRegression()},
                                 {"old_busy", report.old_busy},
                                 {"new_busy", report.new_busy},
                                 {"only_old", report.only_old},
                                 {"only_new", report.only_new},
                                 {"newly_invalid", report.newly_invalid}};
  nlohmann::ordered_json& list = json["comparisons"] = nlohmann::ordered_json::array();
  for (const Comparison& c : report.comparisons) {
    nlohmann::ordered_json item = {{"table", c.table},   {"case", c.case_},
                                   {"metric", c.metric}, {"unit", c.unit},
                                   {"old", c.old_value}, {"new", c.new_value},
                                   {"p_value", nullptr}, {"change", changeName(c.change)}};
    if (c.p_value) item["p_value"] = *c.p_value;
    list.push_back(std::move(item));
  }
  return json.dump(1) + "\n";
}

}  // namespace glintmark
