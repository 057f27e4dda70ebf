// Table "accuracy" as charts.
#pragma once
#include <filesystem>
#include <span>

#include "host/report/record/record.h"

namespace glintmark {

/// Writes accuracy_EFFECT.png and .svg of every effect that has a default and another setting:
/// error over time, both logarithmic, by the part that settings play; the optimal ones joined.
/// Records are those with accuracyDerived(). Throws Error naming a file that cannot be written.
void writeAccuracyCharts(std::span<const Record> records, const std::filesystem::path& folder);

}  // namespace glintmark
