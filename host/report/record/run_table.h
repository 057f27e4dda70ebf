// Any number of runs side by side, as ratios to the first.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/report/record/comparison.h"

namespace glintmark {

/// A figure of the first run and what the others have of it.
struct RunRow {
  std::string table, case_, metric, unit;
  double first = 0;                                 // median
  std::vector<std::optional<Comparison>> others{};  // of the second run on; nothing: not measured
};

struct RunTable {
  std::vector<RunRow> rows;               // figures that another run has too, in the first's order
  std::vector<ComparisonReport> reports;  // of each run but the first, against the first
  bool hasRegression() const;
};

/// Compares every run with the first by compareResults().
RunTable tabulateRuns(std::span<const Results> runs, std::span<const TableSpec> tables,
                      double threshold);

/// A line for each run, then the table: the first run's figures, and the others' over them. "!" is
/// a figure that got worse beyond noise, "~" one within the noise of its measurement or undecided.
/// Without `all`, only figures of which one is neither the same nor within noise. `names`: of the
/// runs.
std::string runTableText(const RunTable& table, std::span<const Results> runs,
                         std::span<const std::string> names, bool all);

/// The comparisons with the first as JSON, schema "glintmark.comparisons/1".
std::string runTableJson(const RunTable& table, std::span<const std::string> names,
                         double threshold);

}  // namespace glintmark
