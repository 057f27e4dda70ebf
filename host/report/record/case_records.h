// The records of one case of a table, by metric.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/report/record/record.h"

namespace glintmark {

class CaseRecords {
 public:
  CaseRecords(std::span<const Record> records, std::string name)
      : records_(records), name_(std::move(name)) {}

  /// Null if the metric was not measured.
  const Record* find(std::string_view metric) const;
  /// The median as a short number, "-" if it was not measured, with "!" if it is not valid.
  std::string text(std::string_view metric) const;
  /// The same without digits after the point, and without "!".
  std::string count(std::string_view metric) const;

 private:
  std::span<const Record> records_;
  std::string name_;
};

/// Names of the cases, each once, in the order of the records.
std::vector<std::string> caseNames(std::span<const Record> records);

}  // namespace glintmark
