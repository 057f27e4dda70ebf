#include "host/report/msbrdf_table.h"

#include <fmt/format.h>

#include <vector>

#include "host/report/text_table.h"

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

}  // namespace

std::string msbrdfTableText(std::span<const Record> records) {
  std::string text = "Energy per order, diffuse, albedo 1, incidence 45 degrees\n";
  text += section(records, "surface/",
                  {"rays_per_s", "order_1", "order_2", "order_3", "order_4", "order_5", "order_6"},
                  {"rays/s", "1", "2", "3", "4", "5", "6"}, "{:.5f}");
  text += "\nModels against the simulation: error of the lobe, energy in the white furnace\n";
  text += section(
      records, "model/",
      {"lobe_error", "lobe_error_published", "lobe_error_eon", "lobe_error_lambert", "furnace",
       "furnace_published", "furnace_eon", "furnace_simulated"},
      {"refit", "published", "EON", "Lambert", "refit", "published", "EON", "simulated"}, "{:.4f}");
  text += fmt::format(
      "\n500 million rays of 4 orders at roughness 0.8: {} ms (paper: about {:.0f} ms)\n"
      "normalised cost {} (the paper's GPU is taken to be a GTX 980)\n"
      "runtime at the bench's size: refit {} ms, published {} ms, EON {} ms; {} x one lane\n"
      "fit of the polynomials {} ms\n",
      cell(records, "all", "simulate_500m_ms", "{:.0f}"), kPat18Ms,
      cell(records, "all", "normalised_cost", "{:.2f}"),
      cell(records, "all", "runtime_ms", "{:.2f}"),
      cell(records, "all", "runtime_published_ms", "{:.2f}"),
      cell(records, "all", "runtime_eon_ms", "{:.2f}"),
      cell(records, "all", "speedup_vs_w1", "{:.1f}"), cell(records, "all", "fit_ms", "{:.0f}"));
  return text;
}

}  // namespace glintmark
