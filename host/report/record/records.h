// Records as JSON and CSV. results/README.md describes the schema.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/report/record/record.h"

namespace glintmark {

inline constexpr std::string_view kResultsSchema = "glintmark.results/1";

/// One run: what was measured, and where.
struct Results {
  RunInfo run;
  std::vector<Record> records;
};

/// The whole file as indented JSON. Values that JSON cannot hold (NaN, infinity) become null and
/// the record invalid. A last field `sum` is a hash of the rest, however numbers and blanks in it
/// are spelt.
std::string toJson(const Results& results);

/// Inverse of toJson. `source` names the text in errors: not JSON (or cut off), another schema, a
/// field missing or of the wrong type, a `sum` that is another's; files without one are read too.
Results fromJson(const std::string& text, const std::string& source);

/// One line each of JSON without newlines, for the running log. `more` counts the records behind
/// this one that belong to it, so that a batch that was cut short can be told from a whole one.
std::string headerLine(const RunInfo& run);
std::string recordLine(const Record& record, std::optional<std::size_t> more = {});
RunInfo parseHeaderLine(const std::string& line, const std::string& source);

struct LogLine {
  Record record;
  std::size_t more = 0;
};
LogLine parseRecordLine(const std::string& line, const std::string& source);

/// CSV of RFC 4180 with a header row; a column `config.KEY` for each key that a record has. Numbers
/// have the digits that give the same double back.
std::string toCsv(const std::vector<Record>& records);

/// Reads a results file of toJson. Throws Error naming the file.
Results readResults(const std::filesystem::path& path);

}  // namespace glintmark
