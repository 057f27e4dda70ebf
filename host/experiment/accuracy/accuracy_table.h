// Table "accuracy": error against time of every effect's settings.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/report/record/table_spec.h"

namespace glintmark {

/// Table "accuracy": names, metrics, what the page shows.
const TableSpec& accuracySpec();

/// Part that a case plays, in its records' configuration under "role".
inline constexpr const char* kAccuracyDefault = "default";
inline constexpr const char* kAccuracyKnob = "knob";
inline constexpr const char* kAccuracyRival = "rival";
/// Empty if the record says none.
std::string accuracyRole(const Record& record);

/// A record `pareto` (0 or 1) of every case that has `error` and `time_ratio`, each effect apart.
/// A setting whose error is not valid is never optimal and stands in nobody's way. Differences that
/// were not measured count for nothing: errors below the truth's own standard error are equal,
/// times within two standard errors of their median are the default's, and errors and times go in
/// steps of kAccuracyStep from the default's.
std::vector<Record> accuracyPareto(std::span<const Record> records);
inline constexpr double kAccuracyStep = 0.05;

/// What the default of an effect buys, and what the next optimal step up or down would cost; empty
/// if the records have no default of it.
std::string accuracySentence(std::span<const Record> records, const std::string& effect);

/// One table for each effect, at most kTableColumnsLimit columns, with its sentence
/// below it.
std::string accuracyTableText(std::span<const Record> records);

}  // namespace glintmark
