// Charts of the page, by kind: bars, curves, trade-offs.
#pragma once
#include <span>
#include <string>

#include "host/report/record/table_spec.h"

namespace glintmark {

/// Where the time of a frame goes, one stacked bar a case that has all `parts`; needs no script.
/// Empty if no case has them.
std::string timeBarsHtml(std::span<const TimePart> parts, std::span<const Record> records);

/// Charts of figures over a knob, for cases "…knob=number" with at least three numbers. The page's
/// script draws them.
std::string curvesHtml(const TableSpec& table, std::span<const Record> records);

/// Two metrics of cases "group/knob=value" against each other, both axes logarithmic, a series a
/// knob. Records say in their configuration, under "role", if a case is the "default" or a "rival".
struct TradeOffChart {
  std::string cost, error;  // the axes' metrics
  std::string noise;        // the error's own standard error, drawn as a line
  std::string optimal;      // 1 for cases that lie on the front
  std::string cost_title, error_title, noise_title;
  std::string tip;  // what a point says, with {error} and {cost}
};
/// The cases of one group; `label` for who cannot see it. The page's script draws it.
std::string tradeOffHtml(const TradeOffChart& chart, const std::string& table,
                         const std::string& group, const std::string& label);

}  // namespace glintmark
