// Simulated surfaces and the analytic models beside them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/core/angles.h"
#include "host/core/stopwatch.h"
#include "host/experiment/frame_timing.h"
#include "host/experiment/msbrdf/msbrdf_cases.h"
#include "host/experiment/msbrdf/msbrdf_table.h"
#include "host/fit/multiscatter_data.h"
#include "host/report/picture/line_chart.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

// Of the furnace integral: its midpoint rule is good to 1e-3.
constexpr double kFurnaceBound = 1.002;

// Energy of a model over the hemisphere, from its energy per solid angle.
double furnace(const std::function<double(double, double)>& model) {
  constexpr int kCosines = 64, kAzimuths = 32;
  double sum = 0;
  for (int i = 0; i < kCosines; ++i)
    for (int j = 0; j < kAzimuths; ++j) {
      const double t = (i + 0.5) / kCosines;  // cosine t^2: finer towards the horizon
      sum += 2 * t * model(t * t, (j + 0.5) * kPi / kAzimuths);
    }
  return 2 * kPi * sum / (kCosines * kAzimuths);
}

// A model's share of order 1, 2 or 3 at albedo 1. EON has single scattering and the rest, which
// stands at 2.
struct EnergyModel {
  const char* name;
  std::function<double(double alpha, double mu, int order)> share;
};

std::vector<EnergyModel> energyModels() {
  const auto lobes = [](const LobePolynomials& set) {
    return [&set](double alpha, double mu, int order) {
      return lobeModelShare(set, alpha, 1, mu, order);
    };
  };
  return {{"published", lobes(kPublishedCode)},
          {"refit", lobes(multiscatterData().refit)},
          {"eon", [](double alpha, double mu, int order) {
             const double single = eonAlbedo(mu, multiscatterData().eon.at(alpha));
             return order == 1 ? single : order == 2 ? 1 - single : 0;
           }}};
}

std::function<double(double, double)> eonOf(double r, double mu_in, double albedo = 1) {
  return
      [=](double cosine, double azimuth) { return eonEnergy(r, mu_in, cosine, azimuth, albedo); };
}

}  // namespace

std::function<double(double, double)> diffuseEnergy(DiffuseModel model, double alpha, double mu_in,
                                                    double albedo) {
  if (model == DiffuseModel::kLambert)
    return [albedo](double cosine, double) { return albedo * cosine / kPi; };
  if (model == DiffuseModel::kEon) return eonOf(multiscatterData().eon.at(alpha), mu_in, albedo);
  if (model == DiffuseModel::kFitted)
    return [fitted = ScatterModel(multiscatterData().fitted.at(alpha)), mu_in, albedo](
               double cosine, double azimuth) {
      return fitted.energy(albedo, mu_in, cosine, azimuth);
    };
  const LobePolynomials& set =
      model == DiffuseModel::kPublished ? kPublishedCode : multiscatterData().refit;
  return [lobes = LobeModel(set, alpha), mu_in, albedo](double cosine, double) {
    return lobes.energy(albedo, mu_in, cosine);
  };
}

void MsbrdfCase::add(const std::string& metric, const Samples& samples, bool valid,
                     const std::string& note) {
  records_.push_back(run_.record(msbrdfSpec(), name_, metric, samples, note));
  records_.back().valid = valid;
}

SimulationSettings diffuseSettings(double alpha, double incidence_deg, int orders,
                                   std::uint64_t rays) {
  SimulationSettings s;
  s.alpha = glm::dvec2(alpha);
  s.incidence_deg = incidence_deg;
  s.orders = orders;
  s.rays = rays;
  return s;
}

std::vector<Record> measureSurface(BenchRun& run, const std::string& name) {
  Simulator simulator(run.device(), run.cache(), run.info().width);
  const SimulationSettings settings =
      diffuseSettings(CaseName::parse(name).number(kAlphaKnob), 45, static_cast<int>(HF_MAX_ORDERS),
                      kMsbrdfSurfaceRays);
  SimulationSettings warm_up = settings;
  warm_up.rays = 1;
  simulator.run(warm_up);
  Simulation simulation{settings, 0, {}};
  Samples rates;
  const Stopwatch watch;
  while (simulation.rays_done < settings.rays) {
    stopIfInterrupted();
    const std::uint64_t before = simulation.rays_done;
    const Stopwatch batch;
    simulator.advance(simulation);
    rates.push_back(static_cast<double>(simulation.rays_done - before) / batch.elapsedNs() * 1e9);
  }
  const bool valid = simulation.balance() == 1 && simulation.gaveUp() == 0;
  MsbrdfCase result(run, name);
  result.add("rays_per_s", rates, valid);
  result.add("simulate_ms", {watch.elapsedNs() * 1e-6}, valid,
             fmt::format("{} rays, 6 orders, incidence 45 degrees", settings.rays));
  result.add("energy_balance", {simulation.balance()}, valid);
  for (int order = 1; order <= settings.orders; ++order)
    result.add(fmt::format("order_{}", order), {orderEnergy(simulation, order)}, valid);
  return result.take();
}

std::vector<Record> measureModel(BenchRun& run, const std::string& name) {
  const double alpha = CaseName::parse(name).number(kAlphaKnob);
  Simulator simulator(run.device(), run.cache(), run.info().width);
  constexpr std::size_t kModels = 6, kWithFurnace = 4;
  constexpr const char* kSuffixes[kModels] = {"",        "_published",    "_eon",
                                              "_fitted", "_eon_unfitted", "_lambert"};
  Samples errors[kModels], furnaces[kWithFurnace], simulated;
  for (const double incidence_deg : kMsbrdfThetas_deg) {
    stopIfInterrupted();
    const Simulation simulation =
        simulator.run(diffuseSettings(alpha, incidence_deg, 6, kMsbrdfModelRays));
    const LobeData data = makeLobeData(simulation, 0);
    const double mu = data.mu_in;
    const std::function<double(double, double)> models[kModels] = {
        diffuseEnergy(DiffuseModel::kRefit, alpha, mu),
        diffuseEnergy(DiffuseModel::kPublished, alpha, mu),
        diffuseEnergy(DiffuseModel::kEon, alpha, mu),
        diffuseEnergy(DiffuseModel::kFitted, alpha, mu),
        eonOf(alpha, mu),
        diffuseEnergy(DiffuseModel::kLambert, alpha, mu)};
    for (std::size_t i = 0; i < kModels; ++i) {
      errors[i].push_back(lobeError(data, models[i]));
      if (i < kWithFurnace) furnaces[i].push_back(furnace(models[i]));
    }
    simulated.push_back(data.share);
  }
  MsbrdfCase result(run, name);
  for (std::size_t i = 0; i < kModels; ++i)
    result.add(fmt::format("lobe_error{}", kSuffixes[i]), errors[i], true,
               "root mean square over mean, over incidences 0 to 80 degrees");
  for (std::size_t i = 0; i < kWithFurnace; ++i) {
    const bool valid = *std::ranges::max_element(furnaces[i]) <= kFurnaceBound;
    result.add(fmt::format("furnace{}", kSuffixes[i]), furnaces[i], valid,
               valid ? "" : "not valid: more energy than came in");
  }
  result.add("furnace_simulated", simulated);
  return result.take();
}

std::vector<Record> measureEnergy(BenchRun& run, const std::string& name) {
  const CaseName parts = CaseName::parse(name);
  const double alpha = parts.number(kAlphaKnob), theta_deg = parts.number(kThetaKnob);
  Simulator simulator(run.device(), run.cache(), run.info().width);
  stopIfInterrupted();
  const Simulation simulation =
      simulator.run(diffuseSettings(alpha, theta_deg, 6, kMsbrdfModelRays));
  const double mu = std::cos(theta_deg * kPi / 180);
  MsbrdfCase result(run, name);
  for (int order = 1; order <= 3; ++order)
    result.add(fmt::format("order_{}", order), {orderEnergy(simulation, order)});
  double rest = 0;
  for (int order = 4; order <= 6; ++order) rest += orderEnergy(simulation, order);
  result.add("rest", {rest}, true, "orders 4 to 6");
  for (const EnergyModel& model : energyModels())
    for (int order = 1; order <= 3; ++order) {
      if (std::string_view(model.name) == "eon" && order == 3) continue;
      result.add(fmt::format("order_{}_{}", order, model.name), {model.share(alpha, mu, order)},
                 true,
                 std::string_view(model.name) == "eon" && order == 2 ? "all orders above 1" : "");
    }
  return result.take();
}

namespace {

// One order over roughness at one incidence [deg], or over incidence at one roughness.
ChartPanel energyPanel(std::span<const Record> records, int order, bool over_alpha, double fixed) {
  constexpr int kSteps = 90;
  ChartPanel panel;
  panel.title = over_alpha ? fmt::format("order {} over roughness, {:.0f} deg", order, fixed)
                           : fmt::format("order {} over incidence, roughness {}", order, fixed);
  panel.x_high = over_alpha ? 1 : 90;
  ChartSeries dots{"simulated", seriesColour(0), {}, {}, true};
  for (const Record& r : records) {
    const CaseName name = CaseName::parse(r.case_);
    if (name.word(0) != kEnergyKind || r.metric != fmt::format("order_{}", order)) continue;
    const double alpha = name.number(kAlphaKnob), theta_deg = name.number(kThetaKnob);
    if ((over_alpha ? theta_deg : alpha) != fixed) continue;
    dots.x.push_back(over_alpha ? alpha : theta_deg);
    dots.y.push_back(r.value.median);
  }
  panel.series.push_back(std::move(dots));
  int colour = 1;
  for (const EnergyModel& model : energyModels()) {
    ChartSeries line{model.name, seriesColour(colour++), {}, {}};
    const bool lacks_order = std::string_view(model.name) == "eon" && order == 3;
    for (int i = 0; i <= kSteps && !lacks_order; ++i) {
      const double x = panel.x_high * i / kSteps;
      const double theta_deg = over_alpha ? fixed : x;
      line.x.push_back(x);
      line.y.push_back(model.share(over_alpha ? x : fixed, std::cos(theta_deg * kPi / 180), order));
    }
    panel.series.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

void writeEnergyChart(std::span<const Record> records, const std::filesystem::path& folder) {
  std::vector<ChartPanel> panels;
  for (const int order : {1, 2, 3}) {
    for (const double theta_deg : {0.0, 60.0})
      panels.push_back(energyPanel(records, order, true, theta_deg));
    for (const double alpha : {0.43, 1.0})
      panels.push_back(energyPanel(records, order, false, alpha));
  }
  writeChart(panels,
             {.columns = 4,
              .panel_width_px = 280,
              .panel_height_px = 190,
              .x_label = "Beckmann roughness, or incidence in degrees",
              .y_label = "share of the energy at albedo 1 (EON, order 2: all above 1)"},
             folder / std::filesystem::path(kEnergyPicture).stem());
}

}  // namespace glintmark
