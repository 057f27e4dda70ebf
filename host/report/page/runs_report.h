// One page of many runs: devices, drivers, lanes and dates side by side.
#pragma once
#include <span>
#include <string>

#include "host/report/record/records.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

/// A run and where it was read from, which the page links.
struct NamedResults {
  std::string source;
  Results results;
};

/// The page as HTML; as htmlReport() it loads nothing. Every table of every run has a section: a
/// chart of its scores (host/report/record/score.h), and rows of runs that sort by any column, with
/// the score metric of each case that some run has. `known` as there.
std::string runsReport(std::span<const NamedResults> runs, std::span<const TableSpec> known);

}  // namespace glintmark
