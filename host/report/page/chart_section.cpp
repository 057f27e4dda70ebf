#include "host/report/page/chart_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "host/report/page/html_text.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr std::size_t kLeastCurvePoints = 3;

// "area_plane/lights=" of "area_plane/lights=4"; empty if the last part is no knob with a number.
std::string knobPrefix(const std::string& case_name) {
  CaseName name = CaseName::parse(case_name);
  if (name.knobs.empty() || !numberOf(name.knobs.back().value)) return "";
  name.knobs.back().value.clear();
  return name.text();
}

std::string curveHtml(const TableSpec& table, const std::string& prefix,
                      const std::vector<std::string>& metrics, const std::string& unit) {
  const std::string title = fmt::format(
      "{} over {}", metrics.size() == 1 ? table.metricTitle(metrics.front(), unit) : "figures",
      prefix.substr(0, prefix.size() - 1));
  return fmt::format(
      "<div class=\"chart small\"><canvas data-chart=\"curve\" data-table=\"{}\" "
      "data-prefix=\"{}\" data-metrics=\"{}\" data-unit=\"{}\" role=\"img\" "
      "aria-label=\"{}\"></canvas></div>\n",
      escapeHtml(table.name), escapeHtml(prefix),
      escapeHtml(fmt::format("{}", fmt::join(metrics, " "))), escapeHtml(unit == "1" ? "" : unit),
      escapeHtml(title));
}

}  // namespace

std::string timeBarsHtml(std::span<const TimePart> parts, std::span<const Record> records) {
  struct Bar {
    std::string name;
    std::vector<double> parts_ms;
    double sum_ms;
  };
  std::vector<Bar> bars;
  double longest_ms = 0;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    Bar bar = {name, std::vector<double>(parts.size()), 0};
    bool complete = !parts.empty();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Record* part = one.find(parts[i].metric);
      complete = complete && part != nullptr;
      bar.parts_ms[i] = part == nullptr ? 0 : std::max(part->value.median, 0.0);
      bar.sum_ms += bar.parts_ms[i];
    }
    if (!complete) continue;
    longest_ms = std::max(longest_ms, bar.sum_ms);
    bars.push_back(bar);
  }
  if (bars.empty() || longest_ms <= 0) return "";
  std::string html = "<h3>Where the time of a frame goes</h3>\n<ul class=\"key\">";
  for (std::size_t i = 0; i < parts.size(); ++i)
    html += fmt::format("<li class=\"part{}\">{}</li>", i, parts[i].name);
  html += "</ul>\n<div class=\"bars\">\n";
  for (const Bar& bar : bars) {
    html += fmt::format("<div class=\"label\">{}</div><div class=\"bar\">", escapeHtml(bar.name));
    for (std::size_t i = 0; i < parts.size(); ++i)
      html += fmt::format(
          "<span class=\"part{}\" style=\"width:{:.2f}%\" title=\"{}: {} ms\"></span>", i,
          88 * bar.parts_ms[i] / longest_ms, parts[i].name, compactNumber(bar.parts_ms[i]));
    html += fmt::format("<b>{} ms</b></div>\n", compactNumber(bar.sum_ms));
  }
  return html + "</div>\n";
}

std::string tradeOffHtml(const TradeOffChart& chart, const std::string& table,
                         const std::string& group, const std::string& label) {
  const auto data = [](const char* name, const std::string& value) {
    return fmt::format(" data-{}=\"{}\"", name, escapeHtml(value));
  };
  return "<div class=\"chart\"><canvas data-chart=\"tradeoff\"" + data("table", table) +
         data("prefix", group + "/") + data("cost", chart.cost) + data("error", chart.error) +
         data("noise", chart.noise) + data("optimal", chart.optimal) +
         data("cost-title", chart.cost_title) + data("error-title", chart.error_title) +
         data("noise-title", chart.noise_title) + data("tip", chart.tip) +
         fmt::format(" role=\"img\" aria-label=\"{}\"></canvas></div>\n", escapeHtml(label));
}

std::string curvesHtml(const TableSpec& table, std::span<const Record> records) {
  std::vector<std::string> prefixes;
  for (const std::string& name : caseNames(records)) {
    const std::string prefix = knobPrefix(name);
    if (!prefix.empty() && std::ranges::find(prefixes, prefix) == prefixes.end())
      prefixes.push_back(prefix);
  }
  std::string html;
  for (const std::string& prefix : prefixes) {
    for (const auto& group : table.curves) {
      std::set<std::string> cases;
      std::vector<std::string> metrics;
      std::string unit;
      for (const std::string& metric : group)
        for (const Record& record : records) {
          if (record.metric != metric || knobPrefix(record.case_) != prefix) continue;
          cases.insert(record.case_);
          unit = record.unit;
          if (metrics.empty() || metrics.back() != metric) metrics.push_back(metric);
        }
      if (cases.size() >= kLeastCurvePoints) html += curveHtml(table, prefix, metrics, unit);
    }
  }
  return html.empty() ? "" : "<div class=\"charts\">\n" + html + "</div>\n";
}

}  // namespace glintmark
