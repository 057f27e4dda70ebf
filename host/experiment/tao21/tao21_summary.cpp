#include "host/experiment/tao21/tao21_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "host/core/stopwatch.h"
#include "host/experiment/tao21/tao21_table.h"
#include "host/experiment/tao21/tao21_view.h"
#include "host/fit/ltc_fit.h"
#include "host/frame/ground_truth.h"
#include "host/report/metrics.h"

namespace glintmark {
namespace {

constexpr double kMsPerNs = 1e-6;
constexpr int kLightCounts[] = {1, 2, 4, 8};
constexpr int kVertexCounts[] = {3, 4, 5, 6, 7, 8};
constexpr int kMostMonteCarloSpp = 1024;
constexpr int kOneLaneReps = 5;
// Cells of the table that is fitted for the time, per side: the time of 64 x 64 follows from it.
constexpr int kTimedTableSize = LTC_SIZE_MIN;

using Samples = std::vector<double>;

// Times of two renderers in turn, as ratios first / second, and those of the first [ms].
struct InTurn {
  Samples ratio, first_ms;
};
InTurn measureInTurn(FrameRenderer& first, FrameRenderer& second, int reps) {
  for (FrameRenderer* renderer : {&first, &second}) {
    renderer->prepare();
    renderer->shade();
  }
  InTurn result;
  for (int rep = 0; rep < reps; ++rep) {
    result.first_ms.push_back(shadeMs(first));
    result.ratio.push_back(result.first_ms.back() / shadeMs(second));
  }
  return result;
}

Samples methodRatio(BenchRun& run, const Scene& scene, const Tao21Settings& settings,
                    LtcMethod method) {
  const View& view = scene.view("near");
  ShadingOptions options = settings.shading, original = settings.shading;
  options.ltc_method = method;
  original.ltc_method = LtcMethod::kOriginal;
  FrameRenderer multi(run.device(), scene, view, options, settings.threads);
  FrameRenderer single(run.device(), scene, view, original, settings.threads);
  return measureInTurn(multi, single, 2 * settings.reps).ratio;
}

struct EqualError {
  double spp = 0, time_ratio = 0;
  bool reached = false;
};

// Samples that Monte Carlo needs for the error of method `exact`, and their time over its.
EqualError monteCarloAtEqualError(BenchRun& run, const Scene& scene,
                                  const Tao21Settings& settings) {
  const View& view = scene.view("middle");
  ShadingOptions small = settings.shading;
  small.width_px = settings.truth_size.width_px;
  small.height_px = settings.truth_size.height_px;
  const TruthImages truth = renderTruth(
      run.device(), scene, view, small, settings.truth_spp, [](int) { stopIfInterrupted(); },
      settings.threads);
  const Image truth_row = coveredPixels(truth.mean);
  FrameRenderer ltc(run.device(), scene, view, small, settings.threads);
  ltc.prepare();
  ltc.shade();
  const double ltc_error = relMse(coveredPixels(ltc.readRadiance()), truth_row);

  TruthRenderer monte_carlo(run.device(), scene, view, small, settings.threads);
  EqualError result;
  double last_error = 0;
  for (int spp = 1; spp <= kMostMonteCarloSpp; spp *= 2) {
    stopIfInterrupted();
    monte_carlo.prepare();
    // Samples that the truth has not used.
    const FrameTimes times = monte_carlo.addSamples(static_cast<std::uint32_t>(settings.truth_spp),
                                                    static_cast<std::uint32_t>(spp));
    const Image image = monte_carlo.readMean(static_cast<std::uint32_t>(spp));
    const double error = relMse(coveredPixels(image), truth_row);
    const double ltc_ms = shadeMs(ltc);
    result.spp = spp;
    result.time_ratio = times.shading_event_ns * kMsPerNs / ltc_ms;
    if (error <= ltc_error) {
      result.reached = true;
      // Between two powers of two the logarithm of the error falls evenly.
      if (spp > 1 && last_error > error) {
        const double back = std::log2(ltc_error / error) / std::log2(last_error / error);
        result.spp *= std::exp2(-back);
        result.time_ratio *= std::exp2(-back);
      }
      break;
    }
    last_error = error;
  }
  return result;
}

double tableFitMs() {
  const Stopwatch watch;
  fitLtcTable(
      {.size = kTimedTableSize, .threads = 0, .progress = [](double) { stopIfInterrupted(); }});
  const double cells = static_cast<double>(LTC_SIZE_DEFAULT) / kTimedTableSize;
  return watch.elapsedNs() * kMsPerNs * cells * cells;
}

AreaLight regularLight(const AreaLight& lamp, int corners) {
  // A polygon of the lamp's size in the lamp's plane.
  const glm::dvec3 centre = 0.5 * (lamp.vertices[0] + lamp.vertices[2]);
  const glm::dvec3 right = 0.5 * (lamp.vertices[1] - lamp.vertices[0]);
  const glm::dvec3 up = 0.5 * (lamp.vertices[3] - lamp.vertices[0]);
  AreaLight light = lamp;
  light.vertices.clear();
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    light.vertices.push_back(centre + std::cos(angle) * right + std::sin(angle) * up);
  }
  return light;
}

}  // namespace

const std::vector<std::string>& tao21SummaryMetrics() {
  static const std::vector<std::string> metrics = {"multiscale_over_original",
                                                   "tao21_over_original",
                                                   "plane_ms",
                                                   "normalised_cost",
                                                   "speedup_vs_w1",
                                                   "mc_spp_at_equal_error",
                                                   "mc_time_at_equal_error_over_ltc",
                                                   "fit_ms"};
  return metrics;
}

std::vector<Record> measureTao21Summary(BenchRun& run) {
  const Tao21Settings settings = tao21Settings(run);
  std::vector<Record> records;
  const auto add = [&](const char* metric, const char* unit, const Samples& samples,
                       const std::string& note) {
    records.push_back(tao21Record(run, "all", metric, unit, samples, note));
  };
  const Scene knot = openScene(run.session().common, "area_knot");
  add("multiscale_over_original", "1", methodRatio(run, knot, settings, LtcMethod::kExact),
      "exact over original, area_knot/near, kernel events in turn");
  records.back().paper = 1;
  add("tao21_over_original", "1", methodRatio(run, knot, settings, LtcMethod::kTao21),
      "tao21 over original, area_knot/near, kernel events in turn");
  records.back().paper = 1;

  const Scene plane = openScene(run.session().common, "area_plane");
  const View& view = plane.view("front");
  ShadingOptions one_lane = settings.shading;
  one_lane.lanes = 1;
  FrameRenderer narrow(run.device(), plane, view, one_lane, settings.threads);
  FrameRenderer wide(run.device(), plane, view, settings.shading, settings.threads);
  const InTurn lanes = measureInTurn(narrow, wide, std::min(settings.reps, kOneLaneReps));
  const bool same = relMse(narrow.readRadiance(), wide.readRadiance()) == 0;
  Samples plane_ms, cost;
  for (int rep = 0; rep < settings.reps; ++rep) plane_ms.push_back(shadeMs(wide));
  const double peak_gflops = measurePeaks(run.device(), run.cache(), settings.shading.lanes).gflops;
  for (int rep = 0; rep < settings.reps; ++rep) plane_ms.push_back(shadeMs(wide));
  for (const double ms : plane_ms)
    cost.push_back(ms * peak_gflops / (kTao21FrameMs * kGtx1070PeakGflops));
  add("plane_ms", "ms", plane_ms, "area_plane/front, kernel events");
  records.back().paper = kTao21FrameMs;
  add("normalised_cost", "1", cost,
      fmt::format("plane_ms x {:.0f} GFLOP/s / (16 ms x 6460 GFLOP/s)", peak_gflops));
  records.back().paper = 1;
  add("speedup_vs_w1", "1", lanes.ratio, "area_plane/front, kernel events in turn");
  records.back().valid = same;
  if (!same) records.back().note = "not valid: W = 1 gives another image";

  const EqualError equal = monteCarloAtEqualError(run, knot, settings);
  const std::string reached =
      equal.reached ? "area_knot/middle, relMSE of method exact"
                    : "area_knot/middle; at that many samples still above the error of exact";
  add("mc_spp_at_equal_error", "1", {equal.spp}, reached);
  add("mc_time_at_equal_error_over_ltc", "1", {equal.time_ratio}, reached);
  add("fit_ms", "ms", {tableFitMs()},
      fmt::format("table of {0}x{0} cells, times the cells of {1}x{1}", kTimedTableSize,
                  LTC_SIZE_DEFAULT));
  return records;
}

std::vector<std::string> tao21CurveCases() {
  std::vector<std::string> cases;
  for (const int count : kLightCounts) cases.push_back(fmt::format("area_plane/lights={}", count));
  for (const int count : kVertexCounts)
    cases.push_back(fmt::format("area_plane/vertices={}", count));
  return cases;
}

std::vector<Record> measureTao21Curve(BenchRun& run, const std::string& case_name) {
  const Tao21Settings settings = tao21Settings(run);
  Scene scene = openScene(run.session().common, "area_plane");
  const AreaLight lamp = scene.area_lights.front();
  const int count = std::stoi(case_name.substr(case_name.find('=') + 1));
  if (case_name.find("lights=") != std::string::npos) {
    scene.area_lights.assign(static_cast<std::size_t>(count), lamp);
  } else {
    scene.area_lights = {regularLight(lamp, count)};
  }
  FrameRenderer renderer(run.device(), scene, scene.view("front"), settings.shading,
                         settings.threads);
  renderer.prepare();
  renderer.shade();
  Samples times_ms;
  for (int rep = 0; rep < settings.reps; ++rep) times_ms.push_back(shadeMs(renderer));
  return {tao21Record(run, case_name, "shading_ms", "ms", times_ms, "kernel events")};
}

}  // namespace glintmark
