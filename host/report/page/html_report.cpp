#include "host/report/page/html_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/page/chart_section.h"
#include "host/report/page/page_frame.h"
#include "host/report/page/table_section.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

std::string factsHtml(const RunInfo& run) {
  std::string html = "<dl class=\"facts\">\n";
  const auto add = [&](const char* name, const std::string& value) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escapeHtml(value));
  };
  add("device", run.device);
  add("platform", run.platform + ", driver " + run.driver);
  add("processor", fmt::format("{}, {} cores", run.cpu, run.cores));
  add("lanes", std::to_string(run.width));
  add("peak", fmt::format("{:.0f} GFLOP/s, {:.1f} GB/s, measured", run.peak_gflops, run.peak_gbs));
  add("measured", run.date + ", version " + run.git);
  if (!run.busy.empty()) add("the machine was busy", run.busy);
  add("command", run.command);
  return html + "</dl>\n";
}

// A figure that the headline's cases have in common, or their range.
std::string headlineFigure(const Headline& headline, const std::vector<double>& values) {
  if (headline.counts_ones) return std::to_string(std::ranges::count(values, 1.0));
  const auto [least, most] = std::ranges::minmax(values);
  return compactNumber(least) + (most > least ? " … " + compactNumber(most) : "");
}

std::string headlinesHtml(std::span<const TableSpec> tables, std::span<const Record> records) {
  std::string html;
  for (const TableSpec& table : tables) {
    if (!table.headline) continue;
    std::vector<double> values;
    for (const Record& record : records)
      if (record.table == table.name && record.metric == table.headline->metric && record.valid)
        values.push_back(record.value.median);
    if (values.empty()) continue;
    html += fmt::format("<a class=\"tile\" href=\"#{}\"><b>{}</b><span>{}</span></a>\n",
                        escapeHtml(table.name), headlineFigure(*table.headline, values),
                        table.headline->text);
  }
  return html.empty() ? "" : "<div class=\"tiles\">\n" + html + "</div>\n";
}

std::string sectionHtml(const TableSpec& table, std::span<const Record> records,
                        PictureShelf& shelf) {
  const std::string paper = paperTablesHtml(table, records);
  std::string html = fmt::format("<section>\n<h2 id=\"{}\">{}</h2>\n", escapeHtml(table.name),
                                 escapeHtml(table.title));
  if (!table.about.empty()) html += fmt::format("<p>{}</p>\n", escapeHtml(table.about));
  if (!table.source.empty() && !paper.empty())
    html += fmt::format("<p class=\"source\">Paper: {}</p>\n", escapeHtml(table.source));
  html += invalidHtml(records) + paper;
  const std::string own = table.section == nullptr ? "" : table.section(records);
  html += own + timeBarsHtml(table.frame_parts, records) + curvesHtml(table, records);
  html += shelf.tablePictures(table, records);
  // What no part of the page is made for stands open.
  return html + allFiguresHtml(records, paper.empty() && own.empty()) + "</section>\n";
}

// JSON inside a script element must not hold "</".
std::string recordsJson(std::span<const Record> records) {
  std::string json = "[";
  for (const Record& record : records) json += (json.size() > 1 ? ",\n" : "") + recordLine(record);
  json += "]";
  std::string safe;
  for (const char c : json) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

std::string headerHtml(const Results& results, std::span<const TableSpec> known,
                       const std::vector<std::string>& tables, const std::string& source) {
  std::string html = fmt::format(
      "<header>\n<h1>glintmark</h1>\n<p class=\"lead\">What micro-detail shading costs on "
      "<b>{}</b>, "
      "and what its accuracy costs.</p>\n{}<details class=\"run\" open><summary>The "
      "run</summary>\n{}"
      "</details>\n<p class=\"source\">{} records: <a href=\"{}\">{}</a>. A figure with "
      "<span class=\"bad\">!</span> failed the check of its run.</p>\n</header>\n<nav "
      "aria-label=\"Sections\">",
      escapeHtml(results.run.device), headlinesHtml(known, results.records), factsHtml(results.run),
      results.records.size(), escapeHtml(linkTo(source)), escapeHtml(source));
  for (const std::string& table : tables)
    html += fmt::format("<a href=\"#{}\">{}</a>", escapeHtml(table),
                        escapeHtml(tableOf(known, table).title));
  return html + "</nav>\n";
}

}  // namespace

std::string htmlReport(const Results& results, std::span<const TableSpec> known,
                       std::span<const ReportPicture> pictures, const std::string& source) {
  std::string html = pageHead("glintmark, " + results.run.device);
  const std::vector<std::string> tables = distinctValues(results.records, &Record::table);
  html += headerHtml(results, known, tables, source) + "<main>\n";
  const std::string end = pageEnd(recordsJson(results.records));

  // Tables are a small multiple of the records, hence the factor.
  const std::size_t others = html.size() + 2 * end.size();
  PictureShelf shelf(pictures, others < kMostPageBytes ? kMostPageBytes - others : 0);
  for (const std::string& table : tables) {
    std::vector<Record> records;
    std::ranges::copy_if(results.records, std::back_inserter(records),
                         [&](const Record& record) { return record.table == table; });
    html += sectionHtml(tableOf(known, table), records, shelf);
  }
  return html + shelf.otherPictures() + end;
}

}  // namespace glintmark
