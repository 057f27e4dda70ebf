#include "host/experiment/msbrdf/msbrdf_bench.h"

#include <fmt/format.h>

#include "host/experiment/msbrdf/msbrdf_cases.h"
#include "host/experiment/msbrdf/msbrdf_table.h"
#include "host/report/picture/image_io.h"

namespace glintmark {
namespace {

std::vector<std::string> alphaCases(const char* kind) {
  std::vector<std::string> cases;
  for (const double alpha : kMsbrdfAlphas) cases.push_back(fmt::format("{}/alpha={}", kind, alpha));
  return cases;
}

std::vector<std::string> energyCases() {
  std::vector<std::string> cases;
  for (const std::string& alpha : alphaCases("energy"))
    for (const int theta_deg : kMsbrdfThetas_deg)
      cases.push_back(fmt::format("{}/theta={}", alpha, theta_deg));
  return cases;
}

void measure(BenchRun& run) {
  const auto bind = [&run](std::vector<Record> (*measureCase)(BenchRun&, const std::string&)) {
    return [&run, measureCase](const std::string& name) { return measureCase(run, name); };
  };
  run.measureCases(kMsbrdfTable, alphaCases("surface"),
                   {"rays_per_s", "simulate_ms", "energy_balance", "order_6"},
                   bind(measureSurface));
  run.measureCases(kMsbrdfTable, alphaCases("model"),
                   {"lobe_error", "furnace", "furnace_simulated"}, bind(measureModel));
  run.measureCases(kMsbrdfTable, energyCases(), {"order_1", "order_2", "order_3", "order_2_eon"},
                   bind(measureEnergy));
  run.measureCases(kMsbrdfTable, alphaCases("metal"),
                   {"furnace_before", "furnace_after", "furnace_after_simulated"},
                   bind(measureMetal));
  run.measureCases(kMsbrdfTable, {"all"},
                   {"runtime_ms", "speedup_vs_w1", "fit_ms", "normalised_cost"},
                   [&run](const std::string&) { return measureMsbrdfCost(run); });
  writePng(energyChart(run.recordsOf(kMsbrdfTable)), run.folder() / "msbrdf_energy.png");
  writePng(sweepPicture(run), run.folder() / "msbrdf_sweep.png");
}

std::string text(const BenchRun& run) {
  const std::vector<Record> records = run.recordsOf(kMsbrdfTable);
  return msbrdfTableText(records) + invalidText(records);
}

}  // namespace

BenchTable msbrdfBench() {
  return {kMsbrdfTable, {}, {}, measure, text};
}

}  // namespace glintmark
