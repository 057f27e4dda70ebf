// Bars, curves, and the two tables that are about more than one paper.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// Where the time of a frame goes, one stacked bar a case; needs no script. Empty for tables that
/// do not time the parts.
std::string timeBarsHtml(std::span<const Record> records);

/// Charts of figures over a knob, for cases "…knob=number" with at least three numbers. The page's
/// script draws them.
std::string curvesHtml(const std::string& table, std::span<const Record> records);

/// Table `accuracy`: per effect a chart of error over time, what the default buys, and the settings
/// behind it.
std::string accuracyHtml(std::span<const Record> records);

/// Table `effects`: the matrix of pairs, and what each set needs.
std::string effectsHtml(std::span<const Record> records);

}  // namespace glintmark
