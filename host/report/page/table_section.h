// Records as tables: beside a paper's figures, and all of them.
#pragma once
#include <span>
#include <string>

#include "host/report/record/table_spec.h"

namespace glintmark {

/// Figures that a paper gives too, one table per metric: paper, here, spread, ratio. Empty if there
/// are none.
std::string paperTablesHtml(const TableSpec& table, std::span<const Record> records);

/// Cases down, metrics across, under a summary that opens; it is open where `open` says so.
std::string allFiguresHtml(std::span<const Record> records, bool open);

/// Why some figures are not valid, one line per case.
std::string invalidHtml(std::span<const Record> records);

}  // namespace glintmark
