// Table "accuracy": error against time of every effect's settings.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/experiment/accuracy/accuracy_settings.h"
#include "host/report/record/table_spec.h"

namespace glintmark {

/// Table "accuracy": names, metrics, what the page shows.
const TableSpec& accuracySpec();

/// Of every case that has `error` and `time_ratio`: a record `pareto` (0 or 1), each effect apart;
/// and, each scene apart too, what equalCosts() gives. A setting whose error is not valid is never
/// optimal and stands in nobody's way; what was not measured decides nothing (SettingGroup).
std::vector<Record> accuracyDerived(std::span<const Record> records);

/// What the default of an effect buys, and what the next optimal step up or down would cost; empty
/// if the records have no default of it.
std::string accuracySentence(std::span<const Record> records, const std::string& effect);

/// Two tables for each effect, at most kTableColumnsLimit columns, with its sentence between them:
/// the settings, and what they are at the default's time and error.
std::string accuracyTableText(std::span<const Record> records);

}  // namespace glintmark
