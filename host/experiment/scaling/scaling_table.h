// Table `scaling` as text.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

/// Table "scaling": names, metrics, what the page shows.
const TableSpec& scalingSpec();

/// The knobs of its cases: pixels down the image, lanes of a work-item, compute units.
inline constexpr const char* kHeightKnob = "height";
inline constexpr const char* kLanesKnob = "lanes";
inline constexpr const char* kThreadsKnob = "threads";

/// A row a case, a rule between the knobs. At most 100 columns.
std::string scalingTableText(std::span<const Record> records);

}  // namespace glintmark
