// What a table of records is called, what it measures, and what the page shows of it. Each table
// has one, written where it is measured (host/experiment); whoever shows tables reads it, and knows
// none by name.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/report/record/record.h"

namespace glintmark {

struct MetricSpec {
  std::string name, unit;    // "shading_ms", "ms"; "1" is no unit
  std::string title = {};    // on the page, "shading time"; empty: the name
  std::string meaning = {};  // in Markdown; empty: said with the metric before it
  std::string cases = {};    // that have it, "surface/alpha=…"; empty: said before, or all
  std::vector<std::string> beside{};  // metrics that stand beside it in the paper's table
};

/// What one figure says about a table: of several cases, from the least to the most.
struct Headline {
  std::string metric, text;  // the text as HTML
  bool counts_ones = false;  // how many cases have the value 1 instead
};

/// One share of a frame's time, "raster_ms".
struct TimePart {
  std::string metric, name;
};

struct PictureSpec {
  std::string file, caption;
  std::string missing{};  // said in its place if it is not there; empty: just that
};

/// Pictures that stand together on the page.
struct PictureGroup {
  enum class Kind {
    kSingle,    // `pictures`, one after another
    kHeatmaps,  // a heatmap of every case that has `metric`, its histogram below
    kStrips,    // a strip of every view, of cases scene/view/method, with a slider
    kHidden,    // `pictures` of the folder that the page need not show
  };
  Kind kind = Kind::kSingle;
  std::string heading{}, text{};
  std::string metric{};  // shown only if a record has it; empty: always
  std::vector<PictureSpec> pictures{};
  bool large = false;
  // Of kStrips: the truth is the first picture instead of the last; differences from it follow;
  // only some views have a strip.
  bool truth_first = false, differences = false, optional = false;
};

struct TableSpec {
  std::string name, title;  // "zk16", "Glints"
  std::string about{};      // one sentence
  std::string source{};     // whose figures stand beside ours, and on what; empty for none
  std::string citation{};   // "[ZK16]"
  std::vector<MetricSpec> metrics{};
  std::vector<std::string> cost_ratios{};  // ratios of times whose numerator is wanted small
  std::optional<Headline> headline{};
  std::string score{};                  // metric of the table's one number; empty: it has none
  std::vector<TimePart> frame_parts{};  // drawn as bars, in the order of a frame
  // Metrics that are drawn over a knob together, the curves of one chart.
  std::vector<std::vector<std::string>> curves{};
  std::vector<PictureGroup> pictures{};
  // HTML of the table's own from its records; null for none.
  std::string (*section)(std::span<const Record> records) = nullptr;

  /// Null if the table has no such metric.
  const MetricSpec* findMetric(std::string_view metric) const;
  /// Throws Error naming the table if it has no such metric.
  const MetricSpec& metric(std::string_view metric) const;
  /// "shading time, ms" of "shading_ms"; a metric without a title stays as it is.
  std::string metricTitle(std::string_view metric, std::string_view unit) const;
};

/// The table of that name among `tables`; one without facts if it is not there.
TableSpec tableOf(std::span<const TableSpec> tables, const std::string& name);

}  // namespace glintmark
