#include "host/experiment/msbrdf/msbrdf_table.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "host/experiment/msbrdf/metal_models.h"
#include "host/experiment/msbrdf/msbrdf_cases.h"
#include "host/experiment/summary_table.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

std::vector<MetricSpec> metrics() {
  return {
      {"rays_per_s", "1/s", "rays per second",
       "diffuse surface, albedo 1, incidence 45°, six orders; 2²² rays, surfaces included",
       "`surface/alpha=…`"},
      {"simulate_ms", "ms", "simulation"},
      {"energy_balance", "1", "energy accounted for",
       "everything counted over the rays; valid only if exactly 1 and no ray was given up"},
      {"order_1", "1", "",
       "energy that leaves after so many bounces, albedo 1; simulated, of `energy/…` orders 1 to 3",
       "`surface/alpha=…`, `energy/alpha=…/theta=…`"},
      {"order_2", "1"},
      {"order_3", "1"},
      {"order_4", "1"},
      {"order_5", "1"},
      {"order_6", "1"},
      {"lobe_error", "1", "error of our lobes",
       "all orders against the simulation: root mean square over mean, over incidences 0 to 80°; "
       "EON with its fitted roughness, and with α itself",
       "`model/alpha=…`"},
      {"lobe_error_published", "1", "error of the published lobes"},
      {"lobe_error_eon", "1", "error of EON"},
      {"lobe_error_fitted", "1", "error of the fitted model"},
      {"lobe_error_eon_unfitted", "1"},
      {"lobe_error_lambert", "1", "error of Lambert"},
      {"furnace", "1", "white furnace",
       "energy of a beam that leaves at albedo 1; not valid above 1.002"},
      {"furnace_published", "1"},
      {"furnace_eon", "1"},
      {"furnace_fitted", "1"},
      {"furnace_simulated", "1"},
      {"rest", "1", "", "simulated energy after 4 to 6 bounces, albedo 1",
       "`energy/alpha=…/theta=…`"},
      {"order_1_published", "1", "",
       "the models' lobes; EON knows single scattering and the rest, which stands at "
       "`order_2_eon`"},
      {"order_2_published", "1"},
      {"order_3_published", "1"},
      {"order_1_refit", "1"},
      {"order_2_refit", "1"},
      {"order_3_refit", "1"},
      {"order_1_eon", "1"},
      {"order_2_eon", "1"},
      {"furnace_before", "1", "",
       "a mirror (f0 = 1) in a white furnace by the shading kernels, over view cosines 0.1 to 1: "
       "as "
       "it is, with its lobe's own energy given back, with the simulated surfaces'",
       "`metal/alpha=…`"},
      {"furnace_after", "1"},
      {"furnace_after_simulated", "1"},
      {"albedo_simulated", "1", "",
       "a coloured metal by its facets' Fresnel reflectance, simulated: what it reflects; samples "
       "are red, green and blue",
       "`conductor/…/alpha=…/theta=…`"},
      {"albedo_error_off", "1", "",
       "albedo by each value of material key `compensation`, over the simulated one − 1"},
      {"albedo_error_lobe", "1"},
      {"albedo_error_simulated", "1"},
      {"albedo_error_mean", "1"},
      {"albedo_error_kulla_conty", "1"},
      {"albedo_error_fdez_aguera", "1"},
      {"lobe_error_off", "1", "",
       "root mean square of the lobe's difference over the simulated mean, cells of 16 × 16 "
       "directions"},
      {"lobe_error_lobe", "1"},
      {"lobe_error_simulated", "1"},
      {"lobe_error_mean", "1"},
      {"lobe_error_kulla_conty", "1"},
      {"lobe_error_fdez_aguera", "1"},
      {"runtime_ms", "ms", "multiple scattering at run time",
       "kernel events with the model (refit; refit with masking; a metal's albedo scaling, or a "
       "lobe beside its own) minus Lambert's, full screen, in turn",
       "`all`"},
      {"runtime_published_ms", "ms"},
      {"runtime_eon_ms", "ms"},
      {"runtime_fitted_ms", "ms"},
      {"runtime_masking_ms", "ms"},
      {"runtime_compensation_ms", "ms"},
      {"runtime_kulla_conty_ms", "ms"},
      {"runtime_fdez_aguera_ms", "ms"},
      {"speedup_vs_w1", "1", "speed-up over one lane",
       "kernel events of the frame with the refit at one lane over all lanes, in turn"},
      {"lambert_ms", "ms", "frame with Lambert", "kernel events of the frame with the effect off"},
      {"fit_ms", "ms", "fit", "polynomials fitted to 48 lobes"},
      {"simulate_500m_ms", "ms", "500 million rays, four orders",
       "four orders at α = 0.8, scaled up to 500 million rays; that × our peak / (500 ms × 4980 "
       "GFLOP/s): [PAT18] names no GPU, a GTX 980 is assumed"},
      {"normalised_cost", "1", "cost per FLOP over the paper's"}};
}

// The cases of a kind, each once.
std::vector<CaseName> casesOf(std::span<const Record> records, const std::string& kind) {
  std::vector<CaseName> cases;
  for (const std::string& name : caseNames(records))
    if (CaseName parts = CaseName::parse(name); parts.word(0) == kind && !parts.knobs.empty())
      cases.push_back(std::move(parts));
  return cases;
}

std::string cell(std::span<const Record> records, const std::string& case_name,
                 const std::string& metric, const char* format) {
  for (const Record& record : records)
    if (record.case_ == case_name && record.metric == metric)
      return fmt::format(fmt::runtime(format), record.value.median) + (record.valid ? "" : "!");
  return "-";
}

std::string section(std::span<const Record> records, const std::string& kind,
                    const std::vector<std::string>& metrics, const std::vector<std::string>& heads,
                    const char* format) {
  std::vector<std::string> header = {kind + "/"};
  header.insert(header.end(), heads.begin(), heads.end());
  TextTable table(header);
  for (const CaseName& name : casesOf(records, kind)) {
    std::vector<std::string> row = {name.rest().text()};
    for (const std::string& metric : metrics)
      row.push_back(cell(records, name.text(), metric, metric == "rays_per_s" ? "{:.3g}" : format));
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
         section(records, kEnergyKind, metrics, heads, "{:.4f}");
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
  for (const CaseName& name : casesOf(records, kMetalKind)) {
    const std::string text = name.text();
    table.addRow({name.rest().text(), range(records, text, "furnace_before"),
                  range(records, text, "furnace_after"),
                  range(records, text, "furnace_after_simulated")});
  }
  return "Mirrors in a white furnace, by the kernels: least and greatest (p95) over view cosines "
         "0.1 to "
         "1\n" +
         table.toString();
}

// Of a metric over all incidences of a metal at one roughness.
struct OverIncidences {
  double worst = 0, mean = 0;  // the first of all channels, as far from 0 as it comes
  int count = 0;
  bool valid = true;
};

OverIncidences overIncidences(std::span<const Record> records, const CaseName& of,
                              const std::string& metric) {
  OverIncidences all;
  for (const Record& record : records) {
    const CaseName name = CaseName::parse(record.case_);
    if (record.metric != metric || name.words != of.words ||
        name.value(kAlphaKnob) != of.value(kAlphaKnob))
      continue;
    for (const double value : {record.value.min, record.value.p95})
      if (std::abs(value) > std::abs(all.worst)) all.worst = value;
    all.mean += record.value.median;
    ++all.count;
    all.valid = all.valid && record.valid;
  }
  if (all.count > 0) all.mean /= all.count;
  return all;
}

std::string conductorSection(std::span<const Record> records, const std::string& error,
                             bool worst) {
  std::vector<std::string> header = {std::string(kConductorKind) + "/"};
  for (const auto& way : kCompensations) header.emplace_back(way.name);
  TextTable table(header);
  for (const CaseName& name : casesOf(records, kConductorKind)) {
    if (name.number(kThetaKnob) != kConductorThetas_deg[0]) continue;
    std::vector<std::string> row = {
        fmt::format("{}/{}/alpha={}", name.word(1), name.word(2), *name.value(kAlphaKnob))};
    for (const auto& way : kCompensations) {
      const OverIncidences all =
          overIncidences(records, name, fmt::format("{}_{}", error, way.name));
      const double value = worst ? all.worst : all.mean;
      const std::string text = worst ? fmt::format("{:+.3f}", value) : fmt::format("{:.3f}", value);
      row.push_back(all.count == 0 ? "-" : text + (all.valid ? "" : "!"));
    }
    table.addRow(row);
  }
  return table.toString();
}

}  // namespace

const TableSpec& msbrdfSpec() {
  static const TableSpec spec = {
      .name = "msbrdf",
      .title = "Multiple scattering",
      .about = "Simulated surfaces, the lobes fitted to them, and what the lobes cost at run time.",
      .source = "Patapom 2018: 500 million rays in half a second; a GeForce GTX 980 is assumed",
      .citation = "[PAT18]",
      .metrics = metrics(),
      .headline = Headline{"runtime_ms", "ms more for multiple scattering, full screen"},
      .score = "simulate_500m_ms",
      .curves = {{"order_1", "order_2", "order_3", "order_4", "order_5", "order_6"},
                 {"lobe_error", "lobe_error_published", "lobe_error_eon", "lobe_error_fitted",
                  "lobe_error_lambert"},
                 {"furnace", "furnace_published", "furnace_eon", "furnace_fitted"},
                 {"furnace_before", "furnace_after", "furnace_after_simulated"},
                 {"albedo_error_off", "albedo_error_lobe", "albedo_error_mean",
                  "albedo_error_kulla_conty", "albedo_error_fdez_aguera"}},
      .pictures = {{.pictures = {{kEnergyPicture, "Energy over roughness and incidence"},
                                 {kSweepPicture,
                                  "Rough clay: rows by model, columns by roughness"}},
                    .large = true}},
  };
  return spec;
}

std::string msbrdfTableText(std::span<const Record> records) {
  std::string text = "Energy per order, diffuse, albedo 1, incidence 45 degrees\n";
  text += section(records, kSurfaceKind,
                  {"rays_per_s", "order_1", "order_2", "order_3", "order_4", "order_5", "order_6"},
                  {"rays/s", "1", "2", "3", "4", "5", "6"}, "{:.5f}");
  text += "\nModels against the simulation: error of the lobe, energy in the white furnace\n";
  text += section(
      records, kModelKind,
      {"lobe_error", "lobe_error_published", "lobe_error_eon", "lobe_error_eon_unfitted",
       "lobe_error_lambert", "furnace", "furnace_published", "furnace_eon", "furnace_simulated"},
      {"refit", "published", "EON", "EON, r=alpha", "Lambert", "refit", "published", "EON",
       "simulated"},
      "{:.4f}");
  for (const int order : {1, 2, 3}) text.append("\n").append(energySection(records, order));
  text.append("\n").append(metalSection(records));
  text +=
      "\nMetals against their simulation: error of the albedo, worst of red, green, blue and\n"
      "incidences 0, 45, 75 degrees\n" +
      conductorSection(records, "albedo_error", true);
  text += "\nError of their lobe's shape: root mean square over the mean, mean over incidences\n" +
          conductorSection(records, "lobe_error", false);
  text += fmt::format(
      "\n500 million rays of 4 orders at roughness 0.8: {} ms (paper: about {:.0f} ms)\n"
      "normalised cost {} (the paper's GPU is taken to be a GTX 980)\n"
      "frame at the bench's size with the effect off: {} ms; more with refit: {}, published: {}, "
      "EON: "
      "{},\nrefit with masking: {}, albedo scaling of metals: {} ms; "
      "{} x one lane\nlobes beside a metal's: Kulla-Conty {}, Fdez-Aguera {} ms\n"
      "fit of the polynomials {} ms\n",
      cell(records, kAllCase, "simulate_500m_ms", "{:.0f}"), kPat18Ms,
      cell(records, kAllCase, "normalised_cost", "{:.2f}"),
      cell(records, kAllCase, "lambert_ms", "{:.2f}"),
      cell(records, kAllCase, "runtime_ms", "{:.2f}"),
      cell(records, kAllCase, "runtime_published_ms", "{:.2f}"),
      cell(records, kAllCase, "runtime_eon_ms", "{:.2f}"),
      cell(records, kAllCase, "runtime_masking_ms", "{:.2f}"),
      cell(records, kAllCase, "runtime_compensation_ms", "{:.2f}"),
      cell(records, kAllCase, "speedup_vs_w1", "{:.1f}"),
      cell(records, kAllCase, "runtime_kulla_conty_ms", "{:.2f}"),
      cell(records, kAllCase, "runtime_fdez_aguera_ms", "{:.2f}"),
      cell(records, kAllCase, "fit_ms", "{:.0f}"));
  return text;
}

}  // namespace glintmark
