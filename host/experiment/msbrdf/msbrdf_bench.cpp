// glintmark bench msbrdf: [PAT18]'s simulation, the models fitted to it, and what they cost.
#include <fmt/format.h>

#include "host/experiment/all_tables.h"
#include "host/experiment/msbrdf/metal_models.h"
#include "host/experiment/msbrdf/msbrdf_cases.h"
#include "host/experiment/msbrdf/msbrdf_table.h"
#include "host/experiment/summary_table.h"
#include "host/parallel/ranks.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

std::vector<std::string> alphaCases(const char* kind) {
  std::vector<std::string> cases;
  for (const double alpha : kMsbrdfAlphas)
    cases.push_back(CaseName{{kind}, {{kAlphaKnob, alpha}}}.text());
  return cases;
}

std::vector<std::string> energyCases() {
  std::vector<std::string> cases;
  for (const double alpha : kMsbrdfAlphas)
    for (const int theta_deg : kMsbrdfThetas_deg)
      cases.push_back(
          CaseName{{kEnergyKind}, {{kAlphaKnob, alpha}, {kThetaKnob, theta_deg}}}.text());
  return cases;
}

std::vector<std::string> conductorCases() {
  std::vector<std::string> cases;
  for (const double alpha : kConductorAlphas)
    for (const Conductor& metal : conductors())
      for (const char* model : {kHeightsModel, kSmithModel})
        for (const int theta_deg : kConductorThetas_deg)
          cases.push_back(CaseName{{kConductorKind, metal.name, model},
                                   {{kAlphaKnob, alpha}, {kThetaKnob, theta_deg}}}
                              .text());
  return cases;
}

void measure(BenchRun& run) {
  const std::string& table = msbrdfSpec().name;
  const auto bind = [&run](std::vector<Record> (*measure_case)(BenchRun&, const std::string&)) {
    return [&run, measure_case](const std::string& name) { return measure_case(run, name); };
  };
  run.measureCases(table, alphaCases(kSurfaceKind),
                   {"rays_per_s", "simulate_ms", "energy_balance", "order_6"},
                   bind(measureSurface));
  run.measureCases(table, alphaCases(kModelKind), {"lobe_error", "furnace", "furnace_simulated"},
                   bind(measureModel));
  run.measureCases(table, energyCases(), {"order_1", "order_2", "order_3", "order_2_eon"},
                   bind(measureEnergy));
  run.measureCases(table, alphaCases(kMetalKind),
                   {"furnace_before", "furnace_after", "furnace_after_simulated"},
                   bind(measureMetal));
  run.measureCases(table, conductorCases(), {"albedo_error_lobe", "lobe_error_lobe"},
                   bind(measureConductor));
  run.measureCases(table, {kAllCase}, {"runtime_ms", "speedup_vs_w1", "fit_ms", "normalised_cost"},
                   [&run](const std::string&) { return measureMsbrdfCost(run); });
  if (!allRanks().isFirst()) return;
  writeEnergyChart(run.recordsOf(table), run.folder());
  writePng(sweepPicture(run), run.folder() / kSweepPicture);
}

std::string text(const BenchRun& run) {
  const std::vector<Record> records = run.recordsOf(msbrdfSpec().name);
  return msbrdfTableText(records) + invalidText(records);
}

}  // namespace

BenchTable msbrdfBench() {
  return {msbrdfSpec(), {}, {}, measure, text};
}

}  // namespace glintmark
