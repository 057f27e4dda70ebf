#include "host/report/page/table_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/report/page/html_text.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

bool hasRatio(const Record& record) {
  return record.paper && *record.paper != 0;
}

double ratioOf(const Record& record) {
  return record.value.median / *record.paper;
}

// The ratio with a bar as long as its share of the largest one.
std::string ratioHtml(const Record& record, double largest) {
  if (!hasRatio(record)) return "<td>–</td>";
  const double share = largest > 0 ? std::clamp(ratioOf(record) / largest, 0.0, 1.0) : 0;
  return fmt::format("<td class=\"ratio\" style=\"--share:{:.3f}\">{}</td>", share,
                     compactNumber(ratioOf(record)));
}

std::string paperTableHtml(const TableSpec& table, const std::string& metric,
                           std::span<const Record> records) {
  std::vector<const Record*> shown;
  double largest = 0;
  for (const Record& record : records) {
    if (!record.paper || record.metric != metric) continue;
    shown.push_back(&record);
    if (hasRatio(record)) largest = std::max(largest, ratioOf(record));
  }
  if (shown.empty()) return "";
  std::vector<std::string> header = {"case", "paper", "here", "±", "here / paper"};
  std::vector<const Record*> samples;  // of the companions, for their units
  std::vector<std::string> beside;
  const MetricSpec* spec = table.findMetric(metric);
  for (const std::string& name : spec == nullptr ? std::vector<std::string>() : spec->beside) {
    const auto found = std::ranges::find(records, name, &Record::metric);
    if (found == records.end()) continue;
    beside.push_back(name);
    header.push_back(escapeHtml(table.metricTitle(name, found->unit)));
  }
  std::vector<std::vector<std::string>> rows;
  for (const Record* record : shown) {
    rows.push_back({rowNameHtml(escapeHtml(record->case_)), cellHtml(compactNumber(*record->paper)),
                    "<td class=\"here\">" + numberHtml(*record) + "</td>",
                    cellHtml(compactNumber(record->value.stddev)), ratioHtml(*record, largest)});
    const CaseRecords one(records, record->case_);
    for (const std::string& name : beside) {
      const Record* other = one.find(name);
      rows.back().push_back(cellHtml(other == nullptr ? "" : numberHtml(*other)));
    }
  }
  return tableHtml(escapeHtml(table.metricTitle(metric, shown.front()->unit)), header, rows);
}

}  // namespace

std::string paperTablesHtml(const TableSpec& table, std::span<const Record> records) {
  std::string html;
  for (const std::string& metric : distinctValues(records, &Record::metric))
    html += paperTableHtml(table, metric, records);
  return html.empty() ? "" : "<div class=\"papers\">\n" + html + "</div>\n";
}

std::string allFiguresHtml(std::span<const Record> records, bool open) {
  const std::vector<std::string> metrics = distinctValues(records, &Record::metric);
  std::vector<std::string> header = {"case"};
  for (const std::string& metric : metrics) {
    const std::string& unit = std::ranges::find(records, metric, &Record::metric)->unit;
    header.push_back(escapeHtml(metric) +
                     (unit.empty() || unit == "1"
                          ? ""
                          : fmt::format("<br><small>{}</small>", escapeHtml(unit))));
  }
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    rows.push_back({rowNameHtml(escapeHtml(name))});
    for (const std::string& metric : metrics) {
      const Record* record = one.find(metric);
      rows.back().push_back(cellHtml(record == nullptr ? "" : numberHtml(*record)));
    }
  }
  return fmt::format("<details{}><summary>All {} figures</summary>\n{}</details>\n",
                     open ? " open" : "", records.size(), tableHtml("", header, rows));
}

std::string invalidHtml(std::span<const Record> records) {
  std::string html;
  std::set<std::string> seen;
  for (const Record& record : records)
    if (!record.valid && seen.insert(record.case_).second)
      html += fmt::format("<p class=\"bad\">{}: {}</p>\n", escapeHtml(record.case_),
                          escapeHtml(record.note));
  return html;
}

}  // namespace glintmark
