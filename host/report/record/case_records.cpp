#include "host/report/record/case_records.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/record/text_table.h"

namespace glintmark {

const Record* CaseRecords::find(std::string_view metric) const {
  const auto found = std::ranges::find_if(records_, [&](const Record& record) {
    return record.case_ == name_ && record.metric == metric;
  });
  return found == records_.end() ? nullptr : &*found;
}

std::string CaseRecords::text(std::string_view metric) const {
  const Record* record = find(metric);
  if (record == nullptr) return "-";
  return compactNumber(record->value.median) + (record->valid ? "" : "!");
}

std::string CaseRecords::count(std::string_view metric) const {
  const Record* record = find(metric);
  return record == nullptr ? "-" : fmt::format("{:.0f}", record->value.median);
}

std::vector<std::string> caseNames(std::span<const Record> records) {
  std::vector<std::string> names;
  for (const Record& record : records) {
    if (std::ranges::find(names, record.case_) == names.end()) names.push_back(record.case_);
  }
  return names;
}

}  // namespace glintmark
