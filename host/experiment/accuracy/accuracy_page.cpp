#include "host/experiment/accuracy/accuracy_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/experiment/accuracy/accuracy_table.h"
#include "host/report/page/chart_section.h"
#include "host/report/page/html_text.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"

namespace glintmark {
namespace {

const TradeOffChart kChart = {.cost = "time_ratio",
                              .error = "error",
                              .noise = "truth_stderr",
                              .optimal = "pareto",
                              .cost_title = "time over the default's",
                              .error_title = "error",
                              .noise_title = "standard error of the truth",
                              .tip = "error {error} in {cost} of the default's time"};

std::string accuracyEffectHtml(std::span<const Record> records, const std::string& effect) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> optimal;
  for (const std::string& case_name : caseNames(records)) {
    const CaseName parts = CaseName::parse(case_name);
    if (parts.words.size() != 1 || parts.word(0) != effect) continue;
    const CaseRecords one(records, case_name);
    if (one.find("time_ratio") == nullptr) continue;  // says more of a setting, is none
    const std::string setting = escapeHtml(CaseName::parse(case_name).rest().text());
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
  std::string html =
      fmt::format("<h3>{}</h3>\n", name) +
      tradeOffHtml(kChart, accuracySpec().name, effect,
                   fmt::format("Error of {} over time; the table below has the numbers", effect));
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

std::string accuracyHtml(std::span<const Record> records) {
  std::vector<std::string> effects;
  for (const std::string& name : caseNames(records)) {
    const std::string effect = CaseName::parse(name).word(0);
    if (std::ranges::find(effects, effect) == effects.end()) effects.push_back(effect);
  }
  std::string html;
  for (const std::string& effect : effects) html += accuracyEffectHtml(records, effect);
  return html;
}

}  // namespace glintmark
