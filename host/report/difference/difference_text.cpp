// What is written of a difference.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/report/difference/image_difference.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

std::string ratioText(const LuminanceRatios& ratios) {
  std::string text;
  if (ratios.largest)
    text = fmt::format(
        "Largest ratio of luminances: {} at pixel ({}, {}), {} against {} in the reference.\n",
        compactNumber(ratios.largest->ratio), ratios.largest->x, ratios.largest->y,
        compactNumber(ratios.largest->value), compactNumber(ratios.largest->reference));
  return text + fmt::format("{} pixels are lit only in the picture, {} only in the reference.\n",
                            ratios.only_image, ratios.only_reference);
}

nlohmann::ordered_json numberJson(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

std::string differenceText(const ImageDifference& difference, const std::string& name,
                           const std::string& reference) {
  TextTable metrics({"metric", "all pixels", "not black"});
  for (const MetricPair& metric : difference.metrics)
    metrics.addRow({fmt::format("{:<16}{}", metric.name, metric.meaning), compactNumber(metric.all),
                    compactNumber(metric.lit)});
  std::vector<std::string> header = {"error of pixels not black"};
  for (const double share : kQuantiles)
    header.push_back(share < 1 ? fmt::format("{:.3g} %", 100 * share) : "largest");
  TextTable quantiles(header);
  for (const ErrorQuantiles& error : difference.quantiles) {
    std::vector<std::string> row = {error.name};
    for (const double value : error.values) row.push_back(compactNumber(value));
    quantiles.addRow(row);
  }
  return fmt::format("{} against {}\n{}x{} pixels of {}, {:.3g} % of them not black\n\n{}\n{}\n{}",
                     name, reference, difference.width, difference.height,
                     difference.is_radiance ? "radiance" : "display values",
                     100 * difference.lit_share, metrics.toString(), quantiles.toString(),
                     ratioText(difference.ratios));
}

std::string differenceJson(const ImageDifference& difference, const std::string& name,
                           const std::string& reference) {
  nlohmann::ordered_json json = {{"schema", "glintmark.difference/1"},
                                 {"picture", name},
                                 {"reference", reference},
                                 {"width", difference.width},
                                 {"height", difference.height},
                                 {"values", difference.is_radiance ? "radiance" : "display"},
                                 {"lit_share", difference.lit_share}};
  for (const MetricPair& metric : difference.metrics)
    json["metrics"][metric.name] = {{"all", numberJson(metric.all)},
                                    {"lit", numberJson(metric.lit)},
                                    {"meaning", metric.meaning}};
  for (const ErrorQuantiles& error : difference.quantiles)
    for (std::size_t i = 0; i < error.values.size(); ++i)
      json["quantiles"][error.name][fmt::format("{}", kQuantiles[i])] = numberJson(error.values[i]);
  const std::optional<PixelRatio>& largest = difference.ratios.largest;
  json["largest_ratio"] = nullptr;
  if (largest)
    json["largest_ratio"] = {{"ratio", largest->ratio},
                             {"x", largest->x},
                             {"y", largest->y},
                             {"value", largest->value},
                             {"reference", largest->reference}};
  json["lit_only_in_picture"] = difference.ratios.only_image;
  json["lit_only_in_reference"] = difference.ratios.only_reference;
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace glintmark
