#include "host/experiment/effects/effects_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/experiment/effects/effects_table.h"
#include "host/report/page/html_text.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
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
      const Record* record =
          CaseRecords(records, row == column ? a : fmt::format("{}+{}", a, b)).find(metric);
      if (record == nullptr) record = CaseRecords(records, fmt::format("{}+{}", b, a)).find(metric);
      any = any || record != nullptr;
      rows.back().push_back(heatCell(record));
    }
  }
  return any ? tableHtml(caption, header, rows) : "";
}

}  // namespace

std::string effectsHtml(std::span<const Record> records) {
  const std::vector<std::string> singles = singleEffects(records);
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
