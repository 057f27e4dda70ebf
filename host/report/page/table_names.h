// What the page calls tables and figures.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glintmark {

struct TableName {
  std::string_view table, title;
  std::string_view source;        // whose figures stand beside ours; empty for none
  std::string_view about;         // one sentence
  std::string_view short_source;  // "[ZK16]"
};
/// Of an unknown table, the table's own name and nothing else; `table` must outlive the result.
TableName tableName(std::string_view table);

/// "shading time, ms" of "shading_ms"; a metric without a name of its own stays as it is.
std::string metricName(std::string_view metric, std::string_view unit);

/// Figures worth standing beside `metric` in a paper's table.
std::vector<std::string> companions(std::string_view table, std::string_view metric);

/// Metrics that are drawn over a knob together, the curves of one chart.
std::span<const std::vector<std::string>> curveGroups();

}  // namespace glintmark
