#include "host/report/record/score.h"

#include <fmt/format.h>

#include <cmath>

namespace glintmark {

std::optional<Score> scoreOf(const TableSpec& table, std::span<const Record> records) {
  Score score;
  double logs = 0;
  for (const Record& record : records) {
    if (record.table != table.name || record.metric != table.score || table.score.empty()) continue;
    if (!record.valid || !(record.value.median > 0) || !std::isfinite(record.value.median))
      continue;
    logs += std::log(record.value.median);
    score.unit = record.unit;
    ++score.cases;
  }
  if (score.cases == 0) return std::nullopt;
  score.value = std::exp(logs / static_cast<double>(score.cases));
  return score;
}

std::string scoreLine(const TableSpec& table, std::span<const Record> records) {
  const std::optional<Score> score = scoreOf(table, records);
  if (!score) return "";
  return fmt::format("score: {} {:.6g} {} {} cases\n", table.name, score->value, score->unit,
                     score->cases);
}

}  // namespace glintmark
