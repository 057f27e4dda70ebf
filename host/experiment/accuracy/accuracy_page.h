// Table "accuracy" on the page.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// Per effect a chart of error over time, what the default buys, and the settings behind it.
std::string accuracyHtml(std::span<const Record> records);

}  // namespace glintmark
