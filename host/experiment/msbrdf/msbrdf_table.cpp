#include "host/experiment/msbrdf/msbrdf_table.h"

#include <fmt/format.h>

#include <vector>

#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

// The cases that begin with `prefix`, each once.
std::vector<std::string> casesOf(std::span<const Record> records, const std::string& prefix) {
  std::vector<std::string> cases;
  for (const Record& record : records)
    if (record.case_.starts_with(prefix) && (cases.empty() || cases.back() != record.case_))
      cases.push_back(record.case_);
  return cases;
}

std::string cell(std::span<const Record> records, const std::string& case_name,
                 const std::string& metric, const char* format) {
  for (const Record& record : records)
    if (record.case_ == case_name && record.metric == metric)
      return fmt::format(fmt::runtime(format), record.value.median) + (record.valid ? "" : "!");
  return "-";
}

std::string section(std::span<const Record> records, const std::string& prefix,
                    const std::vector<std::string>& metrics, const std::vector<std::string>& heads,
                    const char* format) {
  std::vector<std::string> header = {prefix};
  header.insert(header.end(), heads.begin(), heads.end());
  TextTable table(header);
  for (const std::string& name : casesOf(records, prefix)) {
    std::vector<std::string> row = {name.substr(prefix.size())};
    for (const std::string& metric : metrics)
      row.push_back(cell(records, name, metric, metric == "rays_per_s" ? "{:.3g}" : format));
    table.addRow(row);
  }
  return table.toString();
}

// Energy of an order over roughness and incidence, simulated and by the models.
std::string energySection(std::span<const Record> records, int order) {
  const auto metric = [order](const char* model) {
    return fmt::format("order_{}{}", order, model);
  };
  std::vector<std::string> metrics = {metric(""), metric("_published"), metric("_refit")};
  std::vector<std::string> heads = {"simulated", "published", "refit"};
  if (order < 3) {
    metrics.push_back(metric("_eon"));
    heads.push_back(order == 1 ? "EON" : "EON, all above 1");
  }
  return fmt::format("Energy of order {}, albedo 1\n", order) +
         section(records, "energy/", metrics, heads, "{:.4f}");
}

// Least and greatest of a metric.
std::string range(std::span<const Record> records, const std::string& case_name,
                  const std::string& metric) {
  for (const Record& record : records)
    if (record.case_ == case_name && record.metric == metric)
      return fmt::format("{:.3f} {:.3f}{}", record.value.min, record.value.p95,
                         record.valid ? "" : "!");
  return "-";
}

std::string metalSection(std::span<const Record> records) {
  TextTable table({"metal/", "before", "after", "after, simulated table"});
  for (const std::string& name : casesOf(records, "metal/"))
    table.addRow({name.substr(6), range(records, name, "furnace_before"),
                  range(records, name, "furnace_after"),
                  range(records, name, "furnace_after_simulated")});
  return "Mirrors in a white furnace, by the kernels: least and greatest (p95) over view cosines "
         "0.1 to "
         "1\n" +
         table.toString();
}

}  // namespace

std::string msbrdfTableText(std::span<const Record> records) {
  std::string text = "Energy per order, diffuse, albedo 1, incidence 45 degrees\n";
  text += section(records, "surface/",
                  {"rays_per_s", "order_1", "order_2", "order_3", "order_4", "order_5", "order_6"},
                  {"rays/s", "1", "2", "3", "4", "5", "6"}, "{:.5f}");
  text += "\nModels against the simulation: error of the lobe, energy in the white furnace\n";
  text += section(
      records, "model/",
      {"lobe_error", "lobe_error_published", "lobe_error_eon", "lobe_error_eon_unfitted",
       "lobe_error_lambert", "furnace", "furnace_published", "furnace_eon", "furnace_simulated"},
      {"refit", "published", "EON", "EON, r=alpha", "Lambert", "refit", "published", "EON",
       "simulated"},
      "{:.4f}");
  for (const int order : {1, 2, 3}) text += "\n" + energySection(records, order);
  text += "\n" + metalSection(records);
  text += fmt::format(
      "\n500 million rays of 4 orders at roughness 0.8: {} ms (paper: about {:.0f} ms)\n"
      "normalised cost {} (the paper's GPU is taken to be a GTX 980)\n"
      "frame at the bench's size with the effect off: {} ms; more with refit: {}, published: {}, "
      "EON: "
      "{},\nrefit with masking: {}, albedo scaling of metals: {} ms; {} x one lane\n"
      "fit of the polynomials {} ms\n",
      cell(records, "all", "simulate_500m_ms", "{:.0f}"), kPat18Ms,
      cell(records, "all", "normalised_cost", "{:.2f}"),
      cell(records, "all", "lambert_ms", "{:.2f}"), cell(records, "all", "runtime_ms", "{:.2f}"),
      cell(records, "all", "runtime_published_ms", "{:.2f}"),
      cell(records, "all", "runtime_eon_ms", "{:.2f}"),
      cell(records, "all", "runtime_masking_ms", "{:.2f}"),
      cell(records, "all", "runtime_compensation_ms", "{:.2f}"),
      cell(records, "all", "speedup_vs_w1", "{:.1f}"), cell(records, "all", "fit_ms", "{:.0f}"));
  return text;
}

}  // namespace glintmark
