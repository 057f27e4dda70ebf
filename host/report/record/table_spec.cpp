#include "host/report/record/table_spec.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"

namespace glintmark {

const MetricSpec* TableSpec::findMetric(std::string_view metric_name) const {
  const auto found = std::ranges::find(metrics, metric_name, &MetricSpec::name);
  return found == metrics.end() ? nullptr : &*found;
}

const MetricSpec& TableSpec::metric(std::string_view metric_name) const {
  if (const MetricSpec* found = findMetric(metric_name)) return *found;
  throw Error(fmt::format("table {} has no metric {}", name, metric_name));
}

std::string TableSpec::metricTitle(std::string_view metric_name, std::string_view unit) const {
  const MetricSpec* found = findMetric(metric_name);
  std::string text(found == nullptr || found->title.empty() ? metric_name : found->title);
  if (!unit.empty() && unit != "1" && text != unit) text += ", " + std::string(unit);
  return text;
}

TableSpec tableOf(std::span<const TableSpec> tables, const std::string& name) {
  const auto found = std::ranges::find(tables, name, &TableSpec::name);
  return found == tables.end() ? TableSpec{.name = name, .title = name} : *found;
}

}  // namespace glintmark
