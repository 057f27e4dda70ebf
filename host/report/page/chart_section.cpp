#include "host/report/page/chart_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "host/report/accuracy_table.h"
#include "host/report/page/html_text.h"
#include "host/report/page/table_names.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

struct Part {
  std::string_view metric, name;
};
// In the order of a frame.
constexpr std::array<Part, 5> kParts = {{{"raster_ms", "rasterizing"},
                                         {"upload_ms", "upload"},
                                         {"frame_without_ms", "smooth shading"},
                                         {"shading_ms", "glints"},
                                         {"readback_ms", "readback"}}};
constexpr std::size_t kLeastCurvePoints = 3;

// "area_plane/lights=" of "area_plane/lights=4"; empty if the rest is no number.
std::string knobPrefix(const std::string& case_name) {
  const std::size_t end = case_name.rfind('=');
  if (end == std::string::npos) return "";
  double value = 0;
  const char *first = case_name.data() + end + 1, *last = case_name.data() + case_name.size();
  const auto [stop, error] = std::from_chars(first, last, value);
  return error == std::errc() && stop == last ? case_name.substr(0, end + 1) : "";
}

std::string curveHtml(const std::string& table, const std::string& prefix,
                      const std::vector<std::string>& metrics, const std::string& unit) {
  const std::string title =
      fmt::format("{} over {}", metrics.size() == 1 ? metricName(metrics.front(), unit) : "figures",
                  prefix.substr(0, prefix.size() - 1));
  return fmt::format(
      "<div class=\"chart small\"><canvas data-chart=\"curve\" data-table=\"{}\" "
      "data-prefix=\"{}\" data-metrics=\"{}\" data-unit=\"{}\" role=\"img\" "
      "aria-label=\"{}\"></canvas></div>\n",
      escapeHtml(table), escapeHtml(prefix), escapeHtml(fmt::format("{}", fmt::join(metrics, " "))),
      escapeHtml(unit == "1" ? "" : unit), escapeHtml(title));
}

std::string accuracyEffectHtml(std::span<const Record> records, const std::string& effect) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> optimal;
  for (const std::string& case_name : caseNames(records)) {
    if (case_name.substr(0, case_name.find('/')) != effect) continue;
    const CaseRecords one(records, case_name);
    const std::string setting =
        escapeHtml(case_name.substr(std::min(case_name.find('/') + 1, case_name.size())));
    const Record *error = one.find("error"), *pareto = one.find("pareto");
    const bool is_default = error != nullptr && accuracyRole(*error) == kAccuracyDefault;
    const bool is_optimal = pareto != nullptr && pareto->value.median == 1;
    // The default stands under every knob that has it, but is one setting.
    const std::string name = is_default ? "the default" : setting;
    if (is_optimal && std::ranges::find(optimal, name) == optimal.end()) optimal.push_back(name);
    rows.push_back({rowNameHtml(setting + (is_default ? " (default)" : ""))});
    for (const char* metric : {"error", "truth_stderr", "time_ratio"}) {
      const Record* record = one.find(metric);
      rows.back().push_back(cellHtml(record == nullptr ? "–" : numberHtml(*record)));
    }
    rows.back().push_back(cellHtml(is_optimal ? "<span class=\"good\">● optimal</span>" : ""));
  }
  const std::string name = escapeHtml(effect);
  std::string html = fmt::format(
      "<h3>{}</h3>\n<div class=\"chart\"><canvas data-chart=\"accuracy\" data-effect=\"{}\" "
      "role=\"img\" aria-label=\"Error of {} over time; the table below has the "
      "numbers\"></canvas></div>\n",
      name, name, name);
  if (const std::string sentence = accuracySentence(records, effect); !sentence.empty())
    html += fmt::format("<p>{}</p>\n", escapeHtml(sentence));
  if (!optimal.empty())
    html += fmt::format("<p>Pareto-optimal: {}.</p>\n", fmt::join(optimal, ", "));
  return html +
         fmt::format(
             "<details><summary>{} settings of {}</summary>\n{}</details>\n", rows.size(), name,
             tableHtml("", {"setting", "error", "s.e. of the truth", "time / default", "Pareto"},
                       rows));
}

}  // namespace

std::string timeBarsHtml(std::span<const Record> records) {
  struct Bar {
    std::string name;
    std::array<double, kParts.size()> parts_ms;
    double sum_ms;
  };
  std::vector<Bar> bars;
  double longest_ms = 0;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    Bar bar = {name, {}, 0};
    bool complete = true;
    for (std::size_t i = 0; i < kParts.size(); ++i) {
      const Record* part = one.find(kParts[i].metric);
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
  for (std::size_t i = 0; i < kParts.size(); ++i)
    html += fmt::format("<li class=\"part{}\">{}</li>", i, kParts[i].name);
  html += "</ul>\n<div class=\"bars\">\n";
  for (const Bar& bar : bars) {
    html += fmt::format("<div class=\"label\">{}</div><div class=\"bar\">", escapeHtml(bar.name));
    for (std::size_t i = 0; i < kParts.size(); ++i)
      html += fmt::format(
          "<span class=\"part{}\" style=\"width:{:.2f}%\" title=\"{}: {} ms\"></span>", i,
          88 * bar.parts_ms[i] / longest_ms, kParts[i].name, compactNumber(bar.parts_ms[i]));
    html += fmt::format("<b>{} ms</b></div>\n", compactNumber(bar.sum_ms));
  }
  return html + "</div>\n";
}

std::string curvesHtml(const std::string& table, std::span<const Record> records) {
  std::vector<std::string> prefixes;
  for (const std::string& name : caseNames(records)) {
    const std::string prefix = knobPrefix(name);
    if (!prefix.empty() && std::ranges::find(prefixes, prefix) == prefixes.end())
      prefixes.push_back(prefix);
  }
  std::string html;
  for (const std::string& prefix : prefixes) {
    for (const auto& group : curveGroups()) {
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

std::string accuracyHtml(std::span<const Record> records) {
  std::vector<std::string> effects;
  for (const std::string& name : caseNames(records)) {
    const std::string effect = name.substr(0, name.find('/'));
    if (std::ranges::find(effects, effect) == effects.end()) effects.push_back(effect);
  }
  std::string html;
  for (const std::string& effect : effects) html += accuracyEffectHtml(records, effect);
  return html;
}

namespace {

// Of a ratio: 1 is the ground's colour, 3 and more the full accent.
std::string heatCell(const Record* record) {
  if (record == nullptr) return "<td></td>";
  const double heat = std::clamp((record->value.median - 1) / 2, 0.0, 1.0);
  return fmt::format("<td class=\"heat\" style=\"--heat:{:.0f}%\">{}</td>", 70 * heat,
                     numberHtml(*record));
}

std::string matrixHtml(std::span<const Record> records, const std::vector<std::string>& effects,
                       const char* metric, const std::string& caption) {
  std::vector<std::string> header = {""};
  std::vector<std::vector<std::string>> rows;
  bool any = false;
  for (std::size_t row = 0; row < effects.size(); ++row) {
    header.push_back(escapeHtml(effects[row]));
    rows.push_back({rowNameHtml(escapeHtml(effects[row]))});
    for (std::size_t column = 0; column < effects.size(); ++column) {
      const std::string &a = effects[row], &b = effects[column];
      const Record* record = CaseRecords(records, row == column ? a : a + "+" + b).find(metric);
      if (record == nullptr) record = CaseRecords(records, b + "+" + a).find(metric);
      any = any || record != nullptr;
      rows.back().push_back(heatCell(record));
    }
  }
  return any ? tableHtml(caption, header, rows) : "";
}

}  // namespace

std::string effectsHtml(std::span<const Record> records) {
  constexpr double kMiB = 1 << 20;
  std::vector<std::string> singles;
  for (const std::string& name : caseNames(records))
    if (name != "none" && name != "all" && name.find('+') == std::string::npos)
      singles.push_back(name);
  std::string html =
      matrixHtml(records, singles, "uber_over_specialised",
                 "one program with everything over specialised programs, time") +
      matrixHtml(records, singles, "mixed_over_sum",
                 "a frame with both over the sum of what each costs alone; wanted at most 1.1");
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    const auto add = [&](const char* metric, double scale) {
      const Record* record = one.find(metric);
      rows.back().push_back(cellHtml(
          record == nullptr
              ? "–"
              : (scale == 1 ? numberHtml(*record) : compactNumber(record->value.median / scale))));
    };
    rows.push_back({rowNameHtml(escapeHtml(name))});
    add("shading_ms", 1);
    add("uber_over_specialised", 1);
    add("mixed_over_sum", 1);
    add("planes_bytes", kMiB);
    add("tables_bytes", kMiB);
    add("build_ms", 1);
  }
  return html + tableHtml("what each set of effects needs",
                          {"effects", "shading, ms", "one program / specialised", "together / sum",
                           "planes, MiB", "tables, MiB", "build, ms"},
                          rows);
}

}  // namespace glintmark
