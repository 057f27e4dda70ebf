#include "host/report/page/html_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/page/chart_section.h"
#include "host/report/page/page_resources.h"
#include "host/report/page/table_names.h"
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
  add("command", run.command);
  return html + "</dl>\n";
}

struct Headline {
  const char *table, *metric, *text;
};
// What one figure says about a table; of several cases, from the least to the most.
constexpr Headline kHeadlines[] = {
    {"zk16", "normalised_cost", "cost of glints per FLOP, the paper's GPU being 1"},
    {"tan05", "gmm_over_toksvig", "times Toksvig's time for mixtures of normals"},
    {"tao21", "multiscale_over_original", "times the original's time for multi-scale area lights"},
    {"msbrdf", "runtime_ms", "ms more for multiple scattering, full screen"},
    {"effects", "uber_over_specialised", "times as long if every effect is compiled in"},
    {"accuracy", "pareto", "settings on the front of accuracy against time"},
};

std::string headlinesHtml(std::span<const Record> records) {
  std::string html;
  for (const Headline& headline : kHeadlines) {
    std::vector<double> values;
    for (const Record& record : records)
      if (record.table == headline.table && record.metric == headline.metric && record.valid)
        values.push_back(record.value.median);
    if (values.empty()) continue;
    const auto [least, most] = std::ranges::minmax(values);
    std::string figure = compactNumber(least);
    if (std::string_view(headline.metric) == "pareto")
      figure = std::to_string(std::ranges::count(values, 1.0));
    else if (most > least)
      figure += " … " + compactNumber(most);
    html += fmt::format("<a class=\"tile\" href=\"#{}\"><b>{}</b><span>{}</span></a>\n",
                        headline.table, figure, headline.text);
  }
  return html.empty() ? "" : "<div class=\"tiles\">\n" + html + "</div>\n";
}

std::string sectionHtml(const std::string& table, std::span<const Record> records,
                        PictureShelf& shelf) {
  const TableName name = tableName(table);
  const std::string paper = paperTablesHtml(table, records);
  std::string html =
      fmt::format("<section>\n<h2 id=\"{}\">{}</h2>\n", escapeHtml(table), escapeHtml(name.title));
  if (!name.about.empty()) html += fmt::format("<p>{}</p>\n", escapeHtml(name.about));
  if (!name.source.empty() && !paper.empty())
    html += fmt::format("<p class=\"source\">Paper: {}</p>\n", escapeHtml(name.source));
  html += invalidHtml(records) + paper;
  std::string own;
  if (table == "accuracy") own = accuracyHtml(records);
  if (table == "effects") own = effectsHtml(records);
  html += own + timeBarsHtml(records);
  if (table != "accuracy") html += curvesHtml(table, records);
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

std::string headerHtml(const Results& results, const std::vector<std::string>& tables,
                       const std::string& source) {
  const std::string link = escapeHtml(source);
  std::string html = fmt::format(
      "<header>\n<h1>glintmark</h1>\n<p class=\"lead\">What micro-detail shading costs on "
      "<b>{}</b>, "
      "and what its accuracy costs.</p>\n{}<details class=\"run\" open><summary>The "
      "run</summary>\n{}"
      "</details>\n<p class=\"source\">{} records: <a href=\"{}\">{}</a>. A figure with "
      "<span class=\"bad\">!</span> failed the check of its run.</p>\n</header>\n<nav "
      "aria-label=\"Sections\">",
      escapeHtml(results.run.device), headlinesHtml(results.records), factsHtml(results.run),
      results.records.size(), link, link);
  for (const std::string& table : tables)
    html += fmt::format("<a href=\"#{}\">{}</a>", escapeHtml(table),
                        escapeHtml(tableName(table).title));
  return html + "</nav>\n";
}

}  // namespace

std::string htmlReport(const Results& results, std::span<const ReportPicture> pictures,
                       const std::string& source) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" "
      "href=\"data:,\">\n<title>glintmark, " +
      escapeHtml(results.run.device) + "</title>\n<style>\n";
  html += pageCss();
  const std::vector<std::string> tables = distinctValues(results.records, &Record::table);
  html += "</style>\n</head>\n<body>\n" + headerHtml(results, tables, source) + "<main>\n";

  std::string end = "</main>\n<script type=\"application/json\" id=\"records\">" +
                    recordsJson(results.records) + "</script>\n<script>\n";
  end += chartJs();
  end += "\n</script>\n<script>\n";
  end += pageJs();
  end += "</script>\n</body>\n</html>\n";

  // Tables are a small multiple of the records, hence the factor.
  const std::size_t others = html.size() + 2 * end.size();
  PictureShelf shelf(pictures, others < kMostPageBytes ? kMostPageBytes - others : 0);
  for (const std::string& table : tables) {
    std::vector<Record> records;
    std::ranges::copy_if(results.records, std::back_inserter(records),
                         [&](const Record& record) { return record.table == table; });
    html += sectionHtml(table, records, shelf);
  }
  return html + shelf.otherPictures() + end;
}

}  // namespace glintmark
