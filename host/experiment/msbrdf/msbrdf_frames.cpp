// Frames with multiple scattering: furnace of metals, cost, pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "host/core/stopwatch.h"
#include "host/experiment/frame_timing.h"
#include "host/experiment/msbrdf/msbrdf_cases.h"
#include "host/experiment/msbrdf/msbrdf_table.h"
#include "host/experiment/paper_gpu.h"
#include "host/experiment/summary_table.h"
#include "host/frame/white_furnace.h"
#include "host/reference/microfacet.h"
#include "host/report/metrics.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/picture/tonemap.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr int kMostSimulations = 5;
constexpr double kFurnaceCosines[] = {0.1, 0.2, 0.4, 0.6, 0.8, 1.0};
// Furnace by the kernels against the integral of the lobe: 1024 lights and single precision.
constexpr double kFurnaceTolerance = 0.01;
constexpr double kMostFurnace = 1.005;

// The scene with one change to all of its materials, prepared and shaded once.
class ChangedFrame {
 public:
  ChangedFrame(BenchRun& run, Scene scene, const std::function<void(Material&)>& change,
               const ShadingOptions& options)
      : scene_(std::move(scene)) {
    for (Material& material : scene_.materials) change(material);
    renderer_ = preparedFrame(run, scene_, scene_.views.front(), options);
  }
  FrameRenderer& renderer() { return *renderer_; }

 private:
  Scene scene_;
  std::unique_ptr<FrameRenderer> renderer_;
};

void setLambert(Material& material) {
  material.diffuse_model = DiffuseModel::kLambert;
  material.compensation = Compensation::kOff;
}

// Milliseconds of the shading kernels with the change minus Lambert's without any; whether both
// pictures are finite and not negative.
std::pair<Samples, bool> measureChange(BenchRun& run, const Scene& scene,
                                       const std::function<void(Material&)>& change) {
  const ShadingOptions options = run.shading();
  ChangedFrame with(run, scene, change, options), without(run, scene, setLambert, options);
  Samples samples = shadeInTurn(with.renderer(), without.renderer(), run.reps()).differences();
  return {samples,
          isSane(with.renderer().readRadiance()) && isSane(without.renderer().readRadiance())};
}

void addRuntimes(BenchRun& run, const Scene& scene, MsbrdfCase& result) {
  const auto add = [&](const char* metric, const std::function<void(Material&)>& change,
                       const char* note) {
    const auto [samples, sane] = measureChange(run, scene, change);
    result.add(metric, samples, sane,
               sane ? note : "not valid: radiance is negative or not finite");
  };
  const auto model = [](DiffuseModel chosen) {
    return [chosen](Material& material) { material.diffuse_model = chosen; };
  };
  add("runtime_ms", model(DiffuseModel::kRefit),
      "kernel events with the refit minus Lambert's, in turn");
  add("runtime_published_ms", model(DiffuseModel::kPublished), "");
  add("runtime_eon_ms", model(DiffuseModel::kEon), "");
  add("runtime_fitted_ms", model(DiffuseModel::kFitted), "");
  add(
      "runtime_masking_ms",
      [](Material& material) {
        material.diffuse_model = DiffuseModel::kRefit;
        material.diffuse_masking = 0.5;
      },
      "refit with masking and shadowing");
  const auto metal = [](Compensation way) {
    return [way](Material& material) {
      setLambert(material);
      material.compensation = way;
    };
  };
  add("runtime_compensation_ms", metal(Compensation::kLobe), "a metal's albedo scaling alone");
  add("runtime_kulla_conty_ms", metal(Compensation::kKullaConty), "a lobe beside the metal's");
  add("runtime_fdez_aguera_ms", metal(Compensation::kFdezAguera), "a lobe beside the metal's");
}

// One lane's time over that of all lanes; valid if both give the same bits.
void addSpeedup(BenchRun& run, const Scene& scene, MsbrdfCase& result) {
  const auto refit = [](Material& material) { material.diffuse_model = DiffuseModel::kRefit; };
  ShadingOptions one_lane = run.shading();
  one_lane.lanes = 1;
  ChangedFrame narrow(run, scene, refit, one_lane), wide(run, scene, refit, run.shading());
  const Samples samples = shadeInTurn(narrow.renderer(), wide.renderer(), run.reps()).ratios();
  const bool same =
      narrow.renderer().readRadiance().pixels == wide.renderer().readRadiance().pixels;
  result.add("speedup_vs_w1", samples, same,
             same ? "kernel events of the frame with the refit, in turn"
                  : "not valid: one lane gives another picture");
  ChangedFrame lambert(run, scene, setLambert, run.shading());
  const Samples off_ms = shadeTimesMs(lambert.renderer(), run.reps());
  result.add("lambert_ms", off_ms, true, "kernel events of the frame with the effect off");
}

// Milliseconds that 500 million rays of four orders would take, scaled up from fewer.
Samples measureSimulation(BenchRun& run) {
  Simulator simulator(run.device(), run.cache(), run.info().width);
  SimulationSettings settings = diffuseSettings(0.8, 45, 4, 1);
  simulator.run(settings);  // builds the kernels
  settings.rays = kMsbrdfSurfaceRays;
  Samples samples;
  const Repetitions reps = run.reps().atMost(kMostSimulations);
  while (reps.wantsMore({&samples})) {
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
  for (const double alpha : kMsbrdfAlphas)
    for (const int incidence_deg : kMsbrdfThetas_deg) {
      stopIfInterrupted();
      const Simulation s =
          simulator.run(diffuseSettings(alpha, incidence_deg, 4, kMsbrdfModelRays / 8));
      data.push_back(makeLobeData(s, 2));
      data.push_back(makeLobeData(s, 3));
    }
  const Stopwatch watch;
  fitPolynomials(data);
  return watch.elapsedNs() * 1e-6;
}

}  // namespace

std::vector<Record> measureMetal(BenchRun& run, const std::string& name) {
  const double alpha = CaseName::parse(name).number(kAlphaKnob);
  Material mirror;
  mirror.name = "mirror";
  mirror.has_glints = false;
  mirror.params.surface.alpha_g =
      mirror.params.glints.alpha_l = {static_cast<float>(alpha), static_cast<float>(alpha)};
  mirror.params.surface.f0 = {1, 1, 1, 0};
  mirror.params.surface.intensity = 1;
  constexpr std::pair<Compensation, const char*> kWays[] = {
      {Compensation::kOff, "furnace_before"},
      {Compensation::kLobe, "furnace_after"},
      {Compensation::kSimulated, "furnace_after_simulated"}};
  MsbrdfCase result(run, name);
  for (const auto& [way, metric] : kWays) {
    mirror.compensation = way;
    Samples samples;
    bool valid = true;
    for (const double mu : kFurnaceCosines) {
      stopIfInterrupted();
      samples.push_back(whiteFurnace(run.device(), mirror, mu));
      const double lobe = reference::microfacetAlbedo(reference::Ndf::kBeckmann, mu, alpha,
                                                      reference::SmithForm::kRational);
      if (way == Compensation::kOff)
        valid = valid && std::abs(samples.back() - lobe) < kFurnaceTolerance;
      valid = valid && samples.back() <= kMostFurnace;
    }
    result.add(metric, samples, valid,
               valid ? "over view cosines 0.1 to 1"
                     : "not valid: not the lobe's integral, or more than came in");
  }
  return result.take();
}

std::vector<Record> measureMsbrdfCost(BenchRun& run) {
  MsbrdfCase result(run, kAllCase);
  const Scene scene = openScene(run.session().common, "rough_plane");
  addRuntimes(run, scene, result);
  addSpeedup(run, scene, result);
  result.add("fit_ms", {measureFit(run)}, true, "polynomials to 48 lobes");
  Samples simulation_ms = measureSimulation(run);
  const double peak_gflops = measurePeaks(run.device(), run.cache(), run.info().width).gflops;
  result.add("simulate_500m_ms", simulation_ms, true,
             fmt::format("scaled up from {} rays", kMsbrdfSurfaceRays));
  for (double& sample : simulation_ms)
    sample = normalisedCost(sample, peak_gflops, kPat18Ms, kPat18PeakGflops);
  result.add("normalised_cost", simulation_ms);
  return result.take();
}

Image sweepPicture(BenchRun& run) {
  constexpr std::pair<DiffuseModel, const char*> kRows[] = {{DiffuseModel::kLambert, "Lambert"},
                                                            {DiffuseModel::kPublished, "published"},
                                                            {DiffuseModel::kRefit, "refit"},
                                                            {DiffuseModel::kEon, "EON"},
                                                            {DiffuseModel::kFitted, "fitted"}};
  const Scene scene = openScene(run.session().common, "rough_knot");
  const ShadingOptions options{.width_px = 200, .height_px = 160, .lanes = run.info().width};
  std::vector<Image> rows;
  for (const auto& [model, name] : kRows) {
    std::vector<std::pair<std::string, Image>> strip;
    for (const double alpha : {0.1, 0.3, 0.5, 0.75, 1.0}) {
      const DiffuseModel chosen = model;
      ChangedFrame frame(
          run, scene,
          [chosen, alpha](Material& material) {
            material.diffuse_model = chosen;
            material.diffuse_roughness = alpha;
          },
          options);
      strip.emplace_back(
          fmt::format("{} {}", name, alpha),
          toneMap(frame.renderer().readRadiance(), {.exposure = scene.post.exposure}));
    }
    rows.push_back(pictureStrip(strip));
  }
  return pictureColumn(rows);
}

}  // namespace glintmark
