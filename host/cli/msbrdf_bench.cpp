#include "host/cli/msbrdf_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "host/core/stopwatch.h"
#include "host/fit/lobe_fit.h"
#include "host/fit/multiscatter_data.h"
#include "host/frame/frame_renderer.h"
#include "host/report/msbrdf_table.h"
#include "host/simulate/simulation.h"

namespace glintmark {
namespace {

constexpr const char* kTable = "msbrdf";
constexpr double kAlphas[] = {0.1, 0.24, 0.43, 0.62, 0.8, 1.0};
constexpr double kModelIncidences_deg[] = {0, 30, 60, 80};
constexpr std::uint64_t kSurfaceRays = std::uint64_t{1} << 22;
constexpr int kMostSimulations = 5;
constexpr std::uint64_t kModelRays = std::uint64_t{1} << 20;
constexpr double kPi = std::numbers::pi;
// Of the furnace integral: its midpoint rule is good to 1e-3.
constexpr double kFurnaceBound = 1.002;

using Samples = std::vector<double>;

class MsbrdfCase {
 public:
  MsbrdfCase(BenchRun& run, const std::string& name) : run_(run), name_(name) {}
  void add(const std::string& metric, const std::string& unit, const Samples& samples,
           bool valid = true, const std::string& note = "") {
    records_.push_back(run_.record(kTable, name_, metric, unit, samples, note));
    records_.back().valid = valid;
  }
  std::vector<Record> take() { return std::move(records_); }

 private:
  BenchRun& run_;
  std::string name_;
  std::vector<Record> records_;
};

SimulationSettings diffuseSettings(double alpha, double incidence_deg, int orders,
                                   std::uint64_t rays) {
  SimulationSettings s;
  s.alpha = glm::dvec2(alpha);
  s.incidence_deg = incidence_deg;
  s.orders = orders;
  s.rays = rays;
  return s;
}

std::vector<Record> measureSurface(BenchRun& run, const std::string& name, double alpha) {
  Simulator simulator(run.device(), run.cache(), run.info().width);
  const SimulationSettings settings =
      diffuseSettings(alpha, 45, static_cast<int>(HF_MAX_ORDERS), kSurfaceRays);
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
  result.add("rays_per_s", "1/s", rates, valid);
  result.add("simulate_ms", "ms", {watch.elapsedNs() * 1e-6}, valid,
             fmt::format("{} rays, 6 orders, incidence 45 degrees", settings.rays));
  result.add("energy_balance", "1", {simulation.balance()}, valid);
  for (int order = 1; order <= settings.orders; ++order)
    result.add(fmt::format("order_{}", order), "1", {orderEnergy(simulation, order)}, valid);
  return result.take();
}

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

double eonEnergy(double mu_in, double r, double cosine, double azimuth) {
  const double si = std::sqrt(1 - mu_in * mu_in), so = std::sqrt(1 - cosine * cosine);
  const EonValue value =
      eonBrdf({si, 0, mu_in}, {so * std::cos(azimuth), so * std::sin(azimuth), cosine}, r, 1);
  return (value.single + value.multiple) * cosine;
}

std::vector<Record> measureModel(BenchRun& run, const std::string& name, double alpha) {
  Simulator simulator(run.device(), run.cache(), run.info().width);
  Samples errors[4], furnaces[3], simulated;
  for (const double incidence_deg : kModelIncidences_deg) {
    stopIfInterrupted();
    const Simulation simulation =
        simulator.run(diffuseSettings(alpha, incidence_deg, 6, kModelRays));
    const LobeData data = makeLobeData(simulation, 0);
    const double mu = data.mu_in;
    const std::function<double(double, double)> models[] = {
        [&](double cosine, double) {
          return lobeModelEnergy(multiscatterData().refit, alpha, 1, mu, cosine);
        },
        [&](double cosine, double) {
          return lobeModelEnergy(kPublishedCode, alpha, 1, mu, cosine);
        },
        [&](double cosine, double azimuth) {
          return eonEnergy(mu, eonRoughness(alpha), cosine, azimuth);
        },
        [](double cosine, double) { return cosine / kPi; }};
    for (std::size_t i = 0; i < std::size(models); ++i) {
      errors[i].push_back(lobeError(data, models[i]));
      if (i < std::size(furnaces)) furnaces[i].push_back(furnace(models[i]));
    }
    simulated.push_back(data.share);
  }
  constexpr const char* kNames[] = {"", "_published", "_eon", "_lambert"};
  MsbrdfCase result(run, name);
  for (std::size_t i = 0; i < std::size(errors); ++i)
    result.add(fmt::format("lobe_error{}", kNames[i]), "1", errors[i], true,
               "root mean square over mean, over incidences 0 to 80 degrees");
  for (std::size_t i = 0; i < std::size(furnaces); ++i) {
    const bool valid = *std::ranges::max_element(furnaces[i]) <= kFurnaceBound;
    result.add(fmt::format("furnace{}", kNames[i]), "1", furnaces[i], valid,
               valid ? "" : "not valid: more energy than came in");
  }
  result.add("furnace_simulated", "1", simulated);
  return result.take();
}

// A frame of the scene with all its materials of one diffuse model, shaded once.
class ModelFrame {
 public:
  ModelFrame(BenchRun& run, Scene scene, DiffuseModel model, int lanes) : scene_(std::move(scene)) {
    for (Material& material : scene_.materials) material.diffuse_model = model;
    const ImageSize size = parseSize(run.options().size);
    const ShadingOptions options{
        .width_px = size.width_px, .height_px = size.height_px, .lanes = lanes};
    renderer_.emplace(run.device(), scene_, scene_.views.front(), options);
    renderer_->prepare();
    renderer_->shade();
  }
  double shadingMs() { return renderer_->shade().shading_event_ns * 1e-6; }

 private:
  Scene scene_;
  std::optional<FrameRenderer> renderer_;
};

// `combine` of the two frames' milliseconds, in turn.
template <typename Combine>
Samples measureInTurn(BenchRun& run, ModelFrame& a, ModelFrame& b, const Combine& combine) {
  Samples samples;
  for (int rep = 0; rep < run.options().reps; ++rep) {
    stopIfInterrupted();
    const double a_ms = a.shadingMs();
    samples.push_back(combine(a_ms, b.shadingMs()));
  }
  return samples;
}

// Milliseconds of the shading kernels with a model minus Lambert's.
Samples measureRuntime(BenchRun& run, const Scene& scene, DiffuseModel model) {
  ModelFrame with(run, scene, model, run.info().width);
  ModelFrame without(run, scene, DiffuseModel::kLambert, run.info().width);
  return measureInTurn(run, with, without, std::minus<>());
}

// One lane's time over that of all lanes.
Samples measureSpeedup(BenchRun& run, const Scene& scene) {
  ModelFrame narrow(run, scene, DiffuseModel::kRefit, 1);
  ModelFrame wide(run, scene, DiffuseModel::kRefit, run.info().width);
  return measureInTurn(run, narrow, wide, std::divides<>());
}

// Milliseconds that 500 million rays of four orders would take, scaled up from fewer.
Samples measureSimulation(BenchRun& run) {
  Simulator simulator(run.device(), run.cache(), run.info().width);
  SimulationSettings settings = diffuseSettings(0.8, 45, 4, 1);
  simulator.run(settings);  // builds the kernels
  settings.rays = kSurfaceRays;
  Samples samples;
  for (int rep = 0; rep < std::min(run.options().reps, kMostSimulations); ++rep) {
    stopIfInterrupted();
    const Stopwatch watch;
    simulator.run(settings);
    samples.push_back(watch.elapsedNs() * 1e-6 * kPat18Rays / static_cast<double>(settings.rays));
  }
  return samples;
}

double measureFit(BenchRun& run) {
  Simulator simulator(run.device(), run.cache(), run.info().width);
  std::vector<LobeData> data;
  for (const double alpha : kAlphas)
    for (const double incidence_deg : kModelIncidences_deg) {
      const Simulation s = simulator.run(diffuseSettings(alpha, incidence_deg, 4, kModelRays / 8));
      data.push_back(makeLobeData(s, 2));
      data.push_back(makeLobeData(s, 3));
    }
  const Stopwatch watch;
  fitPolynomials(data);
  return watch.elapsedNs() * 1e-6;
}

std::vector<Record> measureAll(BenchRun& run) {
  MsbrdfCase result(run, "all");
  const Scene scene = openScene(run.line().common, "rough_plane");
  result.add("runtime_ms", "ms", measureRuntime(run, scene, DiffuseModel::kRefit), true,
             "kernel events with the refit minus Lambert's, in turn");
  result.add("runtime_published_ms", "ms", measureRuntime(run, scene, DiffuseModel::kPublished));
  result.add("runtime_eon_ms", "ms", measureRuntime(run, scene, DiffuseModel::kEon));
  result.add("speedup_vs_w1", "1", measureSpeedup(run, scene), true,
             "kernel events of the frame with the refit, in turn");
  result.add("fit_ms", "ms", {measureFit(run)}, true, "polynomials to 48 lobes");

  Samples simulation_ms = measureSimulation(run);
  const double peak_gflops = measurePeaks(run.device(), run.cache(), run.info().width).gflops;
  result.add("simulate_500m_ms", "ms", simulation_ms, true,
             fmt::format("scaled up from {} rays", kSurfaceRays));
  for (double& sample : simulation_ms) sample *= peak_gflops / (kPat18Ms * kPat18PeakGflops);
  result.add("normalised_cost", "1", simulation_ms);
  return result.take();
}

std::string alphaCase(const char* kind, double alpha) {
  return fmt::format("{}/alpha={}", kind, alpha);
}

void measure(BenchRun& run) {
  std::vector<std::string> surfaces, models;
  for (const double alpha : kAlphas) {
    surfaces.push_back(alphaCase("surface", alpha));
    models.push_back(alphaCase("model", alpha));
  }
  const auto alphaOf = [](const std::string& name) {
    return std::stod(name.substr(name.find('=') + 1));
  };
  run.measureCases(
      kTable, surfaces, {"rays_per_s", "simulate_ms", "energy_balance", "order_6"},
      [&](const std::string& name) { return measureSurface(run, name, alphaOf(name)); });
  run.measureCases(kTable, models, {"lobe_error", "furnace", "furnace_simulated"},
                   [&](const std::string& name) { return measureModel(run, name, alphaOf(name)); });
  run.measureCases(kTable, {"all"}, {"runtime_ms", "speedup_vs_w1", "fit_ms", "normalised_cost"},
                   [&](const std::string&) { return measureAll(run); });
}

std::string text(const BenchRun& run) {
  return msbrdfTableText(run.recordsOf(kTable));
}

}  // namespace

BenchTable msbrdfBench() {
  return {kTable, {}, {}, measure, text};
}

}  // namespace glintmark
