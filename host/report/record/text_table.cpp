#include "host/report/record/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {

TextTable::TextTable(std::vector<std::string> header) {
  rows_.push_back(std::move(header));
  addRule();
}

void TextTable::addRow(std::vector<std::string> row) {
  if (row.size() != rows_.front().size()) {
    throw Error(fmt::format("a table of {} columns got a row of {} cells", rows_.front().size(),
                            row.size()));
  }
  rows_.push_back(std::move(row));
}

void TextTable::addRule() {
  rows_.emplace_back();
}

std::string TextTable::toString() const {
  std::vector<std::size_t> widths(rows_.front().size());
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], columnsOf(row[c]));
  }
  const std::size_t cells = std::accumulate(widths.begin(), widths.end(), std::size_t{0});
  const std::size_t gaps = widths.size() - 1;
  const std::size_t gap = cells + 2 * gaps <= kTableColumnsLimit ? 2 : 1;
  const std::size_t needed = cells + gap * gaps;
  const std::size_t excess = needed - std::min(needed, kTableColumnsLimit);
  widths[0] -= std::min(excess, widths[0] - 1);
  const std::size_t total = needed - excess;

  std::string text;
  for (const auto& row : rows_) {
    if (row.empty()) {
      text += std::string(total, '-') + '\n';
      continue;
    }
    const std::vector<std::string> names = cellLines(row[0], widths[0]);
    std::string line = fmt::format("{:<{}}", names.front(), widths[0]);
    for (std::size_t c = 1; c < row.size(); ++c) {
      line += fmt::format("{:>{}}", row[c], widths[c] + gap);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
    for (std::size_t i = 1; i < names.size(); ++i) text += names[i] + '\n';
  }
  return text;
}

std::string compactNumber(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size >= 99.95e6) return fmt::format("{:.0f}M", value / 1e6);
  if (size >= 0.9995e6) return fmt::format("{:.1f}M", value / 1e6);
  if (size >= 99999.5) return fmt::format("{:.0f}k", value / 1e3);
  if (size >= 99.95) return fmt::format("{:.0f}", value);
  if (size >= 9.995) return fmt::format("{:.1f}", value);
  if (size >= 0.9995) return fmt::format("{:.2f}", value);
  return fmt::format("{:.3g}", value);
}

}  // namespace glintmark
