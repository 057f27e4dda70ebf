#include "host/experiment/summary_table.h"

#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {

std::string summaryText(std::span<const SummaryRow> rows, std::span<const Record> records) {
  const CaseRecords all(records, kAllCase);
  TextTable table({"over all", "ours", "paper"});
  for (const SummaryRow& row : rows)
    if (all.find(row.metric) != nullptr) table.addRow({row.what, all.text(row.metric), row.paper});
  return table.toString();
}

}  // namespace glintmark
