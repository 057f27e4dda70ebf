#include "host/report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "host/report/page_resources.h"
#include "host/report/text_table.h"

namespace glintmark {
namespace {

struct TableTitle {
  std::string_view table, title, source;
};
constexpr std::array<TableTitle, 6> kTitles = {{
    {"zk16", "Glints", "Zirr & Kaplanyan 2016, Table 1: GeForce GTX 980, 1920×1080"},
    {"tao21", "Area lights", "Tao et al. 2021: GeForce GTX 1070, 1920×1080"},
    {"tan05", "Normal filtering", "Tan et al. 2005: 500×500"},
    {"msbrdf", "Multiple scattering", "Patapom's brute-force ray casting and lobe fit"},
    {"effects", "Effects on demand", ""},
    {"accuracy", "Accuracy against time", ""},
}};

TableTitle titleOf(const std::string& table) {
  const auto found = std::ranges::find(kTitles, table, &TableTitle::table);
  return found != kTitles.end() ? *found : TableTitle{table, table, ""};
}

// Distinct values of a field, in the order of their first appearance.
std::vector<std::string> distinct(std::span<const Record> records, std::string Record::*field) {
  std::vector<std::string> names;
  for (const Record& record : records)
    if (std::ranges::find(names, record.*field) == names.end()) names.push_back(record.*field);
  return names;
}

std::string number(const Record& record) {
  const std::string text = compactNumber(record.value.median);
  return record.valid ? text : fmt::format("<span class=\"bad\">{}!</span>", text);
}

std::string factsHtml(const RunInfo& run) {
  std::string html = "<dl class=\"facts\">\n";
  const auto add = [&](const char* name, const std::string& value) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escapeHtml(value));
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

// Figures that the paper gives too, each figure's cases together.
std::string paperHtml(std::span<const Record> records) {
  std::string rows;
  for (const std::string& metric : distinct(records, &Record::metric)) {
    for (const Record& record : records) {
      if (!record.paper || record.metric != metric) continue;
      rows += fmt::format(
          "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>±{}</td><td>{}</td></tr>\n",
          escapeHtml(record.case_), escapeHtml(metric), compactNumber(*record.paper),
          number(record), compactNumber(record.value.stddev),
          *record.paper != 0 ? compactNumber(record.value.median / *record.paper) : "–");
    }
  }
  if (rows.empty()) return "";
  return "<div class=\"wide\"><table>\n<tr><th>case</th><th>figure</th><th>paper</th><th>here</th>"
         "<th>spread</th><th>here / paper</th></tr>\n" +
         rows + "</table></div>\n";
}

// All figures: cases down, metrics across.
std::string allFiguresHtml(std::span<const Record> records) {
  const std::vector<std::string> metrics = distinct(records, &Record::metric);
  std::string html =
      "<details><summary>All figures</summary>\n<div class=\"wide\"><table>\n<tr>"
      "<th>case</th>";
  for (const std::string& metric : metrics) html += "<th>" + escapeHtml(metric) + "</th>";
  html += "</tr>\n";
  for (const std::string& name : distinct(records, &Record::case_)) {
    html += "<tr><td>" + escapeHtml(name) + "</td>";
    for (const std::string& metric : metrics) {
      const auto found = std::ranges::find_if(records, [&](const Record& record) {
        return record.case_ == name && record.metric == metric;
      });
      html += "<td>" + (found != records.end() ? number(*found) : "") + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table></div></details>\n";
}

// Why some figures are not valid, one line per case.
std::string invalidHtml(std::span<const Record> records) {
  std::string html;
  std::set<std::string> seen;
  for (const Record& record : records)
    if (!record.valid && seen.insert(record.case_).second)
      html += fmt::format("<p class=\"bad\">{}: {}</p>\n", escapeHtml(record.case_),
                          escapeHtml(record.note));
  return html;
}

std::string picturesHtml(std::span<const ReportPicture> pictures) {
  if (pictures.empty()) return "";
  std::string html = "<h2 id=\"pictures\">Pictures</h2>\n<div class=\"pictures\">\n";
  for (const ReportPicture& picture : pictures) {
    const std::string name = escapeHtml(picture.name);
    html += fmt::format(
        "<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption>"
        "</figure>\n",
        name, base64(picture.png_bytes), name);
  }
  return html + "</div>\n";
}

std::string sectionHtml(const std::string& table, std::span<const Record> records) {
  const TableTitle title = titleOf(table);
  std::string html =
      fmt::format("<h2 id=\"{}\">{}</h2>\n", escapeHtml(table), escapeHtml(title.title));
  if (!title.source.empty()) html += fmt::format("<p>{}</p>\n", escapeHtml(title.source));
  html += invalidHtml(records) + paperHtml(records);
  if (table == "zk16")
    html +=
        "<div class=\"chart\"><canvas data-chart=\"breakdown\" data-table=\"zk16\" "
        "role=\"img\" aria-label=\"Where the time of a frame goes\"></canvas></div>\n";
  return html + allFiguresHtml(records);
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

}  // namespace

std::string escapeHtml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string htmlReport(const Results& results, std::span<const ReportPicture> pictures,
                       const std::string& source) {
  const std::string source_html = escapeHtml(source);
  std::string body = fmt::format(
      "<header><h1>glintmark</h1>\n<p>What micro-detail shading costs on this device. Records: <a "
      "href=\"{}\">{}</a>. A figure with ! failed the check of its run.</p>\n{}",
      source_html, source_html, factsHtml(results.run));
  const std::vector<std::string> tables = distinct(results.records, &Record::table);
  body += "<nav>";
  for (const std::string& table : tables)
    body +=
        fmt::format("<a href=\"#{}\">{}</a>", escapeHtml(table), escapeHtml(titleOf(table).title));
  if (!pictures.empty()) body += "<a href=\"#pictures\">Pictures</a>";
  body += "</nav></header>\n<main>\n";
  for (const std::string& table : tables) {
    std::vector<Record> records;
    std::ranges::copy_if(results.records, std::back_inserter(records),
                         [&](const Record& record) { return record.table == table; });
    body += sectionHtml(table, records);
  }
  body += picturesHtml(pictures) + "</main>\n";

  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>glintmark, " +
      escapeHtml(results.run.device) + "</title>\n<style>\n";
  html += pageCss();
  html += "</style>\n</head>\n<body>\n" + body +
          "<script type=\"application/json\" id=\"records\">" + recordsJson(results.records) +
          "</script>\n<script>\n";
  html += chartJs();
  html += "\n</script>\n<script>\n";
  html += pageJs();
  return html + "</script>\n</body>\n</html>\n";
}

}  // namespace glintmark
