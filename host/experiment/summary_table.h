// What a table says over all cases, with the paper's figures.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// The case of figures that are about no single view.
inline constexpr const char* kAllCase = "all";

struct SummaryRow {
  const char *metric, *what, *paper;
};
/// The rows whose metric case "all" has: ours beside the paper's.
std::string summaryText(std::span<const SummaryRow> rows, std::span<const Record> records);

}  // namespace glintmark
