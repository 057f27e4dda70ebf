// Models of multiple scattering between rough diffuse facets, held against simulated surfaces, and
// shorter simulations as their rivals. [PAT18]
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/experiment/accuracy/accuracy_sweep.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/frame_timing.h"
#include "host/experiment/frame_truth.h"
#include "host/experiment/msbrdf/msbrdf_cases.h"
#include "host/fit/lobe_fit.h"
#include "host/parallel/ranks.h"
#include "host/report/metrics.h"
#include "host/report/record/case_name.h"
#include "host/simulate/shared_simulation.h"

namespace glintmark {
namespace {

constexpr double kAlphas[] = {0.43, 0.8};
constexpr int kThetas_deg[] = {0, 70};
constexpr double kClay[] = {0.85, 0.55, 0.4};  // the facets' albedo, rough_plane's
constexpr int kOrders = 6;
// The truth is the mean of so many simulations, of kTruthRays / kTruthSimulations times --rays
// each.
constexpr std::uint32_t kFirstSimulationSeed = 1001, kTruthSimulations = 8, kTruthRays = 2;
constexpr std::uint32_t kRivalSeed = 7;

using Model = NamedModel<DiffuseModel>;
constexpr DiffuseModel kDefaultModel = DiffuseModel::kFitted;  // of the scenes

struct RayCount {
  const char* name;
  std::uint64_t rays;
};
constexpr RayCount kRayCounts[] = {{"1e5", 100'000},
                                   {"1e6", 1'000'000},
                                   {"1e7", 10'000'000},
                                   {"1e8", 100'000'000},
                                   {"5e8", 500'000'000}};

std::string modelCase(const Model& model) {
  return CaseName{{"msbrdf"}, {{"model", model.name}}}.text();
}

std::string raysCase(const RayCount& count) {
  return CaseName{{"msbrdf"}, {{"rays", count.name}}}.text();
}

constexpr int kCells = LobeData::kCosines * LobeData::kAzimuths;

// A lobe as a picture of its cells, 1 for what a white Lambertian surface sends along the normal;
// `energy` of a cell and a facets' albedo.
template <typename Energy>
Image lobeImage(const Energy& energy) {
  Image image(kCells, 1, 3);
  for (int cell = 0; cell < kCells; ++cell)
    for (std::size_t c = 0; c < 3; ++c)
      image.at(cell, 0)[c] =
          static_cast<float>(std::numbers::pi * energy(static_cast<std::size_t>(cell), kClay[c]));
  return image;
}

Image modelImage(DiffuseModel model, double alpha, double mu_in) {
  std::map<double, std::function<double(double, double)>> energies;  // by albedo
  for (const double albedo : kClay) energies[albedo] = diffuseEnergy(model, alpha, mu_in, albedo);
  return lobeImage([&](std::size_t cell, double albedo) {
    const int row = static_cast<int>(cell) / LobeData::kAzimuths;
    const int column = static_cast<int>(cell) % LobeData::kAzimuths;
    return energies[albedo](LobeData::cosine(row), LobeData::azimuth(column));
  });
}

// Light of albedo rho that leaves after S bounces has rho^S of its energy left.
Image simulatedImage(const Simulation& simulation) {
  std::vector<LobeData> orders;
  for (int order = 1; order <= simulation.settings.orders; ++order)
    orders.push_back(makeLobeData(simulation, order));
  return lobeImage([&](std::size_t cell, double albedo) {
    double sum = 0, left = 1;
    for (const LobeData& order : orders) sum += (left *= albedo) * order.energy[cell];
    return sum;
  });
}

// Root mean square difference over the mean of the truth.
double lobeDifference(const Image& lobe, const Image& truth) {
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < lobe.pixels.size(); ++i) {
    const double difference = static_cast<double>(lobe.pixels[i]) - truth.pixels[i];
    squares += difference * difference;
    sum += truth.pixels[i];
  }
  const auto count = static_cast<double>(lobe.pixels.size());
  return sum > 0 ? std::sqrt(squares / count) / (sum / count) : 0;
}

class MsbrdfSweep : public AccuracyEffect {
 public:
  MsbrdfSweep(BenchRun& run, const std::string& scene)
      : run_(run), scene_(scene), simulator_(run.device(), run.cache(), run.info().width) {}

  std::vector<std::string> cases() const override;
  std::vector<Record> measure(const std::string& case_name) override;
  std::string leftOut() const override;
  void prepareTruths() override { truths(allRanks()); }

 private:
  struct Truth {
    double alpha = 0, incidence_deg = 0;
    Image lobe;
    double standard_error = 0;
    std::string failure;
  };
  const std::vector<Truth>& truths(const Ranks& ranks = aloneRanks());
  std::vector<Image> simulate(const Ranks& ranks, const std::vector<SimulationSettings>& runs,
                              std::string& failure);
  std::vector<Record> measureModel(const std::string& case_name, const Model& model);
  std::vector<Record> measureRays(const std::string& case_name, std::uint64_t rays);
  std::unique_ptr<FrameRenderer> frame(const Scene& scene) const;
  const Scene& sceneOf(DiffuseModel model);
  AccuracyFigures figures(const Truth& truth, const Image& lobe) const;
  std::string errorNote() const;

  BenchRun& run_;
  std::string scene_;
  Simulator simulator_;
  std::vector<Truth> truths_;
  std::map<DiffuseModel, Scene> scenes_;
};

std::string MsbrdfSweep::errorNote() const {
  return fmt::format(
      "error: root mean square of the lobe's difference over its mean, albedo {}, against "
      "simulations of {} rays in all, geometric mean over roughness {} and incidence {} degrees; "
      "times of "
      "models: {} at {}",
      fmt::join(kClay, ", "), run_.options().rays * kTruthRays, fmt::join(kAlphas, ", "),
      fmt::join(kThetas_deg, ", "), scene_, run_.options().size);
}

std::vector<std::string> MsbrdfSweep::cases() const {
  std::vector<std::string> cases;
  for (const Model& model : kDiffuseModels) cases.push_back(modelCase(model));
  for (const RayCount& count : kRayCounts)
    if (count.rays <= run_.options().rays) cases.push_back(raysCase(count));
  return cases;
}

std::string MsbrdfSweep::leftOut() const {
  std::vector<std::string> left;
  for (const RayCount& count : kRayCounts)
    if (count.rays > run_.options().rays) left.push_back(fmt::format("rays={}", count.name));
  return left.empty() ? ""
                      : fmt::format("Not measured, being beyond --rays {}: {}.",
                                    run_.options().rays, fmt::join(left, ", "));
}

// Of all `ranks`, which share the runs: what leaves in each of them.
std::vector<Image> MsbrdfSweep::simulate(const Ranks& ranks,
                                         const std::vector<SimulationSettings>& runs,
                                         std::string& failure) {
  std::vector<Image> lobes;
  for (const Simulation& simulation : simulateShared(ranks, simulator_, runs, stopIfInterrupted)) {
    if (simulation.balance() != 1 || simulation.gaveUp() > 0)
      failure = "the simulation lost or gave up rays";
    lobes.push_back(simulatedImage(simulation));
  }
  return lobes;
}

const std::vector<MsbrdfSweep::Truth>& MsbrdfSweep::truths(const Ranks& ranks) {
  if (!truths_.empty()) return truths_;
  std::vector<SimulationSettings> runs;
  for (const double alpha : kAlphas)
    for (const int incidence_deg : kThetas_deg)
      for (std::uint32_t i = 0; i < kTruthSimulations; ++i) {
        runs.push_back(diffuseSettings(alpha, incidence_deg, kOrders,
                                       run_.options().rays * kTruthRays / kTruthSimulations));
        runs.back().seed = kFirstSimulationSeed + i;
      }
  std::string failure;
  const std::vector<Image> all = simulate(ranks, runs, failure);
  for (std::size_t first = 0; first < runs.size(); first += kTruthSimulations) {
    const std::span<const Image> lobes(&all[first], kTruthSimulations);
    Truth truth{runs[first].alpha.x, runs[first].incidence_deg, Image(kCells, 1, 3), 0, failure};
    for (const Image& lobe : lobes)
      for (std::size_t k = 0; k < truth.lobe.pixels.size(); ++k)
        truth.lobe.pixels[k] += lobe.pixels[k] / kTruthSimulations;
    truth.standard_error = errorOfMean(truth.lobe, lobes, lobeDifference);
    truths_.push_back(std::move(truth));
  }
  return truths_;
}

AccuracyFigures MsbrdfSweep::figures(const Truth& truth, const Image& lobe) const {
  AccuracyFigures figures;
  figures.truth_stderr = truth.standard_error;
  figures.failure = truth.failure;
  if (!isSane(lobe)) {
    figures.failure = "the lobe has values that are negative or not finite";
    return figures;
  }
  figures.error = lobeDifference(lobe, truth.lobe);
  figures.bias = relativeBias(lobe, truth.lobe);
  figures.rel_mse = relMse(lobe, truth.lobe);
  figures.colour_error = colourError(lobe, truth.lobe);
  return figures;
}

const Scene& MsbrdfSweep::sceneOf(DiffuseModel model) {
  const auto found = scenes_.find(model);
  if (found != scenes_.end()) return found->second;
  Scene scene = openScene(run_.session().common, CaseName::parse(scene_).word(0));
  for (Material& material : scene.materials) material.diffuse_model = model;
  return scenes_.emplace(model, std::move(scene)).first->second;
}

std::unique_ptr<FrameRenderer> MsbrdfSweep::frame(const Scene& scene) const {
  return preparedFrame(run_, scene, scene.view(CaseName::parse(scene_).word(1)), run_.shading());
}

std::vector<Record> MsbrdfSweep::measureModel(const std::string& case_name, const Model& model) {
  std::vector<AccuracyFigures> all;
  for (const Truth& truth : truths())
    all.push_back(figures(
        truth, modelImage(model.model, truth.alpha, std::cos(glm::radians(truth.incidence_deg)))));
  AccuracyFigures mean = meanFigures(all);
  const bool is_default = model.model == kDefaultModel;
  const auto standard = frame(sceneOf(kDefaultModel)), own = frame(sceneOf(model.model));
  if (!isSane(own->readRadiance())) mean.failure = "radiance is negative or not finite";
  AccuracyTimes times = timesInTurn(*standard, *own, run_.options().reps);
  if (is_default) times.ratio = {1};
  return accuracyRecords(run_, case_name, is_default ? kAccuracyDefault : kAccuracyKnob, mean,
                         times,
                         {errorNote(), "kernel events of a frame, in turn with the default"});
}

std::vector<Record> MsbrdfSweep::measureRays(const std::string& case_name, std::uint64_t rays) {
  const auto standard = frame(sceneOf(kDefaultModel));
  std::vector<AccuracyFigures> all;
  AccuracyTimes times;
  for (const Truth& truth : truths()) {
    std::string failure;
    const double standard_ms = shadeMs(*standard);
    const Stopwatch watch;
    SimulationSettings settings = diffuseSettings(truth.alpha, truth.incidence_deg, kOrders, rays);
    settings.seed = kRivalSeed;
    const Image lobe = simulate(aloneRanks(), {settings}, failure).front();
    times.ms.push_back(watch.elapsedNs() * 1e-6);
    times.ratio.push_back(times.ms.back() / standard_ms);
    all.push_back(figures(truth, lobe));
    if (!failure.empty()) all.back().failure = failure;
  }
  return accuracyRecords(run_, case_name, kAccuracySampled, meanFigures(all), times,
                         {errorNote(),
                          "one simulation (of one incidence) over one frame of the default, in "
                          "turn"});
}

std::vector<Record> MsbrdfSweep::measure(const std::string& case_name) {
  for (const Model& model : kDiffuseModels)
    if (case_name == modelCase(model)) return measureModel(case_name, model);
  for (const RayCount& count : kRayCounts)
    if (case_name == raysCase(count)) return measureRays(case_name, count.rays);
  throw Error(fmt::format("no case {}", case_name));
}

}  // namespace

AccuracyKind msbrdfAccuracy() {
  return {
      "msbrdf",
      {"model", "rays"},
      {"rough_plane/oblique", "rough_knot/front"},
      {"rough_plane/oblique"},
      [](BenchRun& run, const std::vector<std::string>& scenes) {
        return std::unique_ptr<AccuracyEffect>(std::make_unique<MsbrdfSweep>(run, scenes.front()));
      }};
}

}  // namespace glintmark
