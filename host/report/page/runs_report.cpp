#include "host/report/page/runs_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/report/page/html_report.h"
#include "host/report/page/page_frame.h"
#include "host/report/record/case_records.h"
#include "host/report/record/score.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

// What tells one run from another, in a few words.
std::string runLabel(const RunInfo& run) {
  return fmt::format("{}, {} lanes, {}", run.device, run.width, run.date.substr(0, 10));
}

std::vector<Record> tableRecords(const Results& results, const std::string& table) {
  std::vector<Record> records;
  std::ranges::copy_if(results.records, std::back_inserter(records),
                       [&](const Record& record) { return record.table == table; });
  return records;
}

// A cell that sorts by `key` and shows `html`.
std::string sortableCell(const std::string& key, const std::string& html) {
  return fmt::format("<td data-key=\"{}\">{}</td>", escapeHtml(key), html);
}

// A run's record of a metric; the last of a case counts.
const Record* recordOf(std::span<const Record> records, const std::string& case_name,
                       const std::string& metric) {
  const Record* found = nullptr;
  for (const Record& record : records)
    if (record.case_ == case_name && record.metric == metric) found = &record;
  return found;
}

struct TableOfRuns {
  const TableSpec& spec;
  std::vector<const NamedResults*> runs{};
  std::vector<std::vector<Record>> records{};  // of each run
  std::vector<std::string> cases{};            // that some run has the score metric of

  TableOfRuns(const TableSpec& table, std::span<const NamedResults> all) : spec(table) {
    for (const NamedResults& run : all) {
      std::vector<Record> own = tableRecords(run.results, spec.name);
      if (own.empty()) continue;
      for (const Record& record : own)
        if (record.metric == spec.score && std::ranges::find(cases, record.case_) == cases.end())
          cases.push_back(record.case_);
      runs.push_back(&run);
      records.push_back(std::move(own));
    }
  }

  std::vector<std::string> row(std::size_t i) const;
  std::string chart() const;
  std::string html() const;
};

std::vector<std::string> TableOfRuns::row(std::size_t i) const {
  const RunInfo& run = runs[i]->results.run;
  const std::optional<Score> score = scoreOf(spec, records[i]);
  std::vector<std::string> cells = {
      rowNameHtml(fmt::format("<a href=\"{}\">{}</a>", escapeHtml(linkTo(runs[i]->source)),
                              escapeHtml(run.device))),
      sortableCell(run.driver, escapeHtml(run.driver)),
      sortableCell(std::to_string(run.width), std::to_string(run.width)),
      sortableCell(run.date,
                   escapeHtml(run.date.substr(0, 10)) + (run.busy.empty() ? "" : " (busy)")),
      sortableCell(fmt::format("{}", run.peak_gflops), compactNumber(run.peak_gflops))};
  if (cases.empty()) {
    cells.push_back(
        sortableCell(std::to_string(records[i].size()), std::to_string(records[i].size())));
    return cells;
  }
  cells.push_back(score ? sortableCell(fmt::format("{:.6g}", score->value),
                                       "<b>" + compactNumber(score->value) + "</b>")
                        : sortableCell("", "–"));
  for (const std::string& name : cases) {
    const Record* record = recordOf(records[i], name, spec.score);
    cells.push_back(record == nullptr ? sortableCell("", "")
                                      : sortableCell(fmt::format("{}", record->value.median),
                                                     numberHtml(*record)));
  }
  return cells;
}

std::string TableOfRuns::chart() const {
  std::vector<std::string> labels, values;
  std::string unit;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::optional<Score> score = scoreOf(spec, records[i]);
    if (!score) continue;
    labels.push_back(runLabel(runs[i]->results.run));
    std::ranges::replace(labels.back(), ';', ',');
    values.push_back(fmt::format("{:.6g}", score->value));
    unit = score->unit;
  }
  if (labels.empty()) return "";
  const std::string title =
      fmt::format("{}, geometric mean over cases", spec.metricTitle(spec.score, unit));
  return fmt::format(
      "<div class=\"chart\" style=\"height:{}rem\"><canvas data-chart=\"runs\" data-labels=\"{}\" "
      "data-values=\"{}\" data-title=\"{}\" role=\"img\" aria-label=\"{}\"></canvas></div>\n",
      6 + 2 * labels.size(), escapeHtml(fmt::format("{}", fmt::join(labels, ";"))),
      fmt::join(values, ";"), escapeHtml(title), escapeHtml(title));
}

std::string TableOfRuns::html() const {
  std::string html = fmt::format("<section>\n<h2 id=\"{}\">{}</h2>\n", escapeHtml(spec.name),
                                 escapeHtml(spec.title));
  if (!spec.about.empty()) html += fmt::format("<p>{}</p>\n", escapeHtml(spec.about));
  std::vector<std::string> header = {"device", "driver", "lanes", "date", "peak, GFLOP/s"};
  std::string caption = "Runs";
  if (cases.empty()) {
    header.push_back("records");
  } else {
    header.push_back("score");
    for (const std::string& name : cases) header.push_back(escapeHtml(name));
    caption = escapeHtml(spec.metricTitle(spec.score, spec.metric(spec.score).unit));
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < runs.size(); ++i) rows.push_back(row(i));
  return html + chart() + "<div class=\"sortable\">\n" + tableHtml(caption, header, rows) +
         "</div>\n</section>\n";
}

std::vector<std::string> tableNames(std::span<const NamedResults> runs) {
  std::vector<std::string> names;
  for (const NamedResults& run : runs)
    for (const std::string& name : distinctValues(run.results.records, &Record::table))
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

// Tables in the order of `known`, then others.
std::vector<TableSpec> tablesOf(std::span<const NamedResults> runs,
                                std::span<const TableSpec> known) {
  const std::vector<std::string> names = tableNames(runs);
  std::vector<TableSpec> tables;
  for (const TableSpec& table : known)
    if (std::ranges::find(names, table.name) != names.end()) tables.push_back(table);
  for (const std::string& name : names)
    if (std::ranges::find(known, name, &TableSpec::name) == known.end())
      tables.push_back(tableOf(known, name));
  return tables;
}

}  // namespace

std::string runsReport(std::span<const NamedResults> runs, std::span<const TableSpec> known) {
  const std::vector<TableSpec> tables = tablesOf(runs, known);
  std::string html = pageHead(fmt::format("glintmark, {} runs", runs.size()));
  html += fmt::format(
      "<header>\n<h1>glintmark</h1>\n<p class=\"lead\">{} runs side by side. A click on a column's "
      "name sorts by it; a device's name leads to its records.</p>\n</header>\n<nav "
      "aria-label=\"Sections\">",
      runs.size());
  for (const TableSpec& table : tables)
    html += fmt::format("<a href=\"#{}\">{}</a>", escapeHtml(table.name), escapeHtml(table.title));
  html += "</nav>\n<main>\n";
  for (const TableSpec& table : tables) html += TableOfRuns(table, runs).html();
  return html + pageEnd("[]");
}

}  // namespace glintmark
