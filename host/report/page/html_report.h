// One self-contained page of a run: facts, the papers' tables beside ours, charts, pictures.
#pragma once
#include <span>
#include <string>

#include "host/report/page/html_text.h"
#include "host/report/page/pictures.h"
#include "host/report/record/records.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

/// The page must stay light enough to be mailed and opened on a phone; pictures that would make it
/// larger are left out, and it says so in their places.
inline constexpr std::size_t kMostPageBytes = 10'000'000;

/// The page as HTML. It loads nothing: style, script, charts' library and pictures are part of it.
/// Tables and pictures show without script. Headlines stand in the order of `known`; a table that
/// is not among them is shown by its records alone. `source` names the results file, which is
/// linked.
std::string htmlReport(const Results& results, std::span<const TableSpec> known,
                       std::span<const ReportPicture> pictures, const std::string& source);

/// Script elements of every page: its records, Chart.js, its own.
inline constexpr std::size_t kPageScripts = 3;

}  // namespace glintmark
