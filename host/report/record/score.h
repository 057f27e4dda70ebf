// One number of a table, for programs that follow it over drivers and machines.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "host/report/record/table_spec.h"

namespace glintmark {

struct Score {
  double value = 0;  // geometric mean over the cases
  std::string unit;
  std::size_t cases = 0;
};

/// The geometric mean of the table's score metric over all cases that are valid and above 0;
/// nothing if the table has none or none was measured.
std::optional<Score> scoreOf(const TableSpec& table, std::span<const Record> records);

/// "score: zk16 61.3482 ms 10 cases\n". The form of this line never changes: results/README.md.
/// Empty without a score.
std::string scoreLine(const TableSpec& table, std::span<const Record> records);

}  // namespace glintmark
