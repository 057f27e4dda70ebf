#include "host/report/record/run_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

bool isWithinNoise(Change change) {
  return change == Change::kSame || change == Change::kNoise;
}

std::string ratioCell(double first, const std::optional<Comparison>& other) {
  if (!other) return "";
  const char* mark = other->change == Change::kWorse ? "!"
                     : other->change == Change::kNoise || other->change == Change::kUndecided ||
                             other->change == Change::kBusy
                         ? "~"
                         : "";
  return (first == 0 ? "-" : fmt::format("{:.3f}", other->new_value / first)) + mark;
}

}  // namespace

bool RunTable::hasRegression() const {
  return std::ranges::any_of(reports, &ComparisonReport::hasRegression);
}

RunTable tabulateRuns(std::span<const Results> runs, std::span<const TableSpec> tables,
                      double threshold) {
  RunTable table;
  const std::vector<Record>& first = runs.front().records;
  std::vector<RunRow> rows(first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    rows[i] = {first[i].table,        first[i].case_,
               first[i].metric,       first[i].unit,
               first[i].value.median, std::vector<std::optional<Comparison>>(runs.size() - 1)};
  for (std::size_t run = 1; run < runs.size(); ++run) {
    table.reports.push_back(compareResults(runs.front(), runs[run], tables, threshold));
    for (const Comparison& c : table.reports.back().comparisons)
      rows[c.old_index].others[run - 1] = c;
  }
  std::ranges::copy_if(rows, std::back_inserter(table.rows), [](const RunRow& row) {
    return std::ranges::any_of(row.others, [](const auto& other) { return other.has_value(); });
  });
  return table;
}

std::string runTableText(const RunTable& table, std::span<const Results> runs,
                         std::span<const std::string> names, bool all) {
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunInfo& run = runs[i].run;
    text += fmt::format("{}: {}\n   {} ({}, {} lanes), {}, {}{}\n", i + 1, names[i], run.device,
                        run.driver, run.width, run.git, run.date,
                        run.busy.empty() ? "" : "; the machine was busy");
  }
  std::vector<std::string> header = {"figure", "metric", "1"};
  for (std::size_t i = 1; i < runs.size(); ++i) header.push_back(fmt::format("{}/1", i + 1));
  TextTable figures(header);
  std::size_t hidden = 0;
  for (const RunRow& row : table.rows) {
    const bool changed = std::ranges::any_of(
        row.others, [](const auto& other) { return other && !isWithinNoise(other->change); });
    if (!all && !changed) {
      ++hidden;
      continue;
    }
    std::vector<std::string> cells = {row.table + " " + row.case_, row.metric,
                                      compactNumber(row.first)};
    for (const auto& other : row.others) cells.push_back(ratioCell(row.first, other));
    figures.addRow(cells);
  }
  if (hidden < table.rows.size()) text += fmt::format("\n{}", figures.toString());
  text += fmt::format(
      "\n{} figures compared, {} of them alike in all runs{}.\n"
      "!: worse beyond noise. ~: within noise or undecided.\n",
      table.rows.size(), hidden, all ? "" : " and not shown");
  for (std::size_t i = 0; i < table.reports.size(); ++i)
    for (const std::string& name : table.reports[i].newly_invalid)
      text += fmt::format("{} was valid and is not any more in run {}.\n", name, i + 2);
  return text;
}

std::string runTableJson(const RunTable& table, std::span<const std::string> names,
                         double threshold) {
  nlohmann::ordered_json json = {{"schema", "glintmark.comparisons/1"},
                                 {"regression", table.hasRegression()},
                                 {"first", names.front()}};
  nlohmann::ordered_json& others = json["others"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < table.reports.size(); ++i)
    others.push_back({{"file", names[i + 1]},
                      {"comparison", nlohmann::ordered_json::parse(
                                         comparisonJson(table.reports[i], threshold))}});
  return json.dump(1) + "\n";
}

}  // namespace glintmark
