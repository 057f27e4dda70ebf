// Table "accuracy": error against time of every effect's settings.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/report/record.h"

namespace glintmark {

/// Part that a case plays, in its records' configuration under "role".
inline constexpr const char* kAccuracyDefault = "default";
inline constexpr const char* kAccuracyKnob = "knob";
inline constexpr const char* kAccuracyRival = "rival";

/// A record `pareto` (0 or 1) of every case that has `error` and `time_ratio`, each effect apart.
/// Differences that were not measured count for nothing: errors below the truth's own standard
/// error are equal, and errors and times go in steps of kAccuracyStep from the default's.
std::vector<Record> accuracyPareto(std::span<const Record> records);
inline constexpr double kAccuracyStep = 0.05;

/// One table for each effect, at most kTableColumnsLimit columns, with a sentence below it: what
/// the default buys, and what the next optimal step up or down would cost.
std::string accuracyTableText(std::span<const Record> records);

}  // namespace glintmark
