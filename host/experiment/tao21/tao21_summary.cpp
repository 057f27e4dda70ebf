#include "host/experiment/tao21/tao21_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/stopwatch.h"
#include "host/experiment/frame_timing.h"
#include "host/experiment/frame_truth.h"
#include "host/experiment/paper_gpu.h"
#include "host/experiment/summary_table.h"
#include "host/experiment/tao21/tao21_table.h"
#include "host/experiment/tao21/tao21_view.h"
#include "host/fit/ltc_fit.h"
#include "host/report/metrics.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr const char* kCurveView = "front";
constexpr const char *kLightsKnob = "lights", *kVerticesKnob = "vertices";
constexpr int kLightCounts[] = {1, 2, 4, 8};
constexpr int kVertexCounts[] = {3, 4, 5, 6, 7, 8};
constexpr const char* kShapeKnob = "shape";
constexpr std::pair<const char*, LightShape> kShapes[] = {
    {"disc", LightShape::kDisc}, {"sphere", LightShape::kSphere}, {"tube", LightShape::kTube}};
constexpr int kMostMonteCarloSpp = 1024;
// Cells of the table that is fitted for the time, per side: the time of 64 x 64 follows from it.
constexpr int kTimedTableSize = LTC_SIZE_MIN;

// Times of a method over the original one's, in turn.
Samples methodRatio(BenchRun& run, const Scene& scene, LtcMethod method) {
  const View& view = scene.view("near");
  ShadingOptions options = run.shading(), original = options;
  options.ltc_method = method;
  original.ltc_method = LtcMethod::kOriginal;
  const auto multi = preparedFrame(run, scene, view, options);
  const auto single = preparedFrame(run, scene, view, original);
  return shadeInTurn(*multi, *single, run.reps().scaled(2)).ratios();
}

struct EqualError {
  double spp = 0, time_ratio = 0;
  bool reached = false;
};

// Samples that Monte Carlo needs for the error of method `exact`, and their time over its.
EqualError monteCarloAtEqualError(BenchRun& run, const Scene& scene) {
  const Tao21Settings settings = tao21Settings(run);
  const View& view = scene.view("middle");
  const Image truth_row =
      coveredPixels(truthOf(run, scene, view, settings.errors, settings.truth_spp).images.mean);
  const auto ltc = preparedFrame(run, scene, view, settings.errors);
  const double ltc_error = relMse(coveredPixels(ltc->readRadiance()), truth_row);

  TruthRenderer monte_carlo(run.device(), scene, view, settings.errors, run.threads());
  EqualError result;
  double last_error = 0;
  for (int spp = 1; spp <= kMostMonteCarloSpp; spp *= 2) {
    stopIfInterrupted();
    const SampledFrame frame = sampleFrame(monte_carlo, spp);
    const double error = relMse(coveredPixels(frame.mean), truth_row);
    result.spp = spp;
    result.time_ratio = frame.shading_ms / shadeMs(*ltc);
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

// A disc or a sphere of the lamp's area, as seen from before it, or a tube along its middle.
AreaLight roundLight(const AreaLight& lamp, LightShape shape) {
  constexpr double kTubeRadius = 0.1;
  AreaLight light = lamp;
  light.vertices.clear();
  light.shape = shape;
  light.centre = 0.5 * (lamp.vertices[0] + lamp.vertices[2]);
  light.axis = areaLightNormal(lamp);
  light.radius = std::sqrt(areaLightArea(lamp) / std::numbers::pi);
  if (shape == LightShape::kTube) {
    light.axis = lamp.vertices[1] - lamp.vertices[0];
    light.centre -= 0.5 * light.axis;
    light.radius = kTubeRadius;
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

namespace {

// One quad, full screen: its time, what that is of the paper's, and what lanes are worth.
void addPlane(BenchRun& run, std::vector<Record>& records) {
  const Scene plane = openScene(run.session().common, kTao21SummaryScene);
  const View& view = plane.view(kCurveView);
  const Repetitions reps = run.reps();
  ShadingOptions one_lane = run.shading();
  one_lane.lanes = 1;
  const auto narrow = preparedFrame(run, plane, view, one_lane);
  const auto wide = preparedFrame(run, plane, view, run.shading());
  const Samples lanes = shadeInTurn(*narrow, *wide, reps.atMost(kOneLaneReps)).ratios();
  const bool same = relMse(narrow->readRadiance(), wide->readRadiance()) == 0;
  Samples plane_ms = shadeTimesMs(*wide, reps), cost;
  const double peak_gflops = measurePeaks(run.device(), run.cache(), run.info().width).gflops;
  for (const double ms : shadeTimesMs(*wide, reps)) plane_ms.push_back(ms);
  for (const double ms : plane_ms)
    cost.push_back(normalisedCost(ms, peak_gflops, kTao21FrameMs, kGtx1070PeakGflops));
  const auto add = [&](const char* metric, const Samples& samples, const std::string& note) {
    records.push_back(run.record(tao21Spec(), kAllCase, metric, samples, note));
  };
  add("plane_ms", plane_ms, "area_plane/front, kernel events");
  records.back().paper = kTao21FrameMs;
  add("normalised_cost", cost,
      fmt::format("plane_ms x {:.0f} GFLOP/s / (16 ms x 6460 GFLOP/s)", peak_gflops));
  records.back().paper = 1;
  add("speedup_vs_w1", lanes, "area_plane/front, kernel events in turn");
  records.back().valid = same;
  if (!same) records.back().note = "not valid: W = 1 gives another image";
}

}  // namespace

std::vector<Record> measureTao21Summary(BenchRun& run) {
  std::vector<Record> records;
  const auto add = [&](const char* metric, const Samples& samples, const std::string& note) {
    records.push_back(run.record(tao21Spec(), kAllCase, metric, samples, note));
  };
  const Scene knot = openScene(run.session().common, "area_knot");
  add("multiscale_over_original", methodRatio(run, knot, LtcMethod::kExact),
      "exact over original, area_knot/near, kernel events in turn");
  records.back().paper = 1;
  add("tao21_over_original", methodRatio(run, knot, LtcMethod::kTao21),
      "tao21 over original, area_knot/near, kernel events in turn");
  records.back().paper = 1;
  addPlane(run, records);
  const EqualError equal = monteCarloAtEqualError(run, knot);
  const std::string reached =
      equal.reached ? "area_knot/middle, relMSE of method exact"
                    : "area_knot/middle; at that many samples still above the error of exact";
  add("mc_spp_at_equal_error", {equal.spp}, reached);
  add("mc_time_at_equal_error_over_ltc", {equal.time_ratio}, reached);
  add("fit_ms", {tableFitMs()},
      fmt::format("table of {0}x{0} cells, times the cells of {1}x{1}", kTimedTableSize,
                  LTC_SIZE_DEFAULT));
  return records;
}

std::vector<std::string> tao21CurveCases() {
  std::vector<std::string> cases;
  const auto add = [&](const char* knob, int count) {
    cases.push_back(CaseName{{kTao21SummaryScene}, {{knob, count}}}.text());
  };
  for (const int count : kLightCounts) add(kLightsKnob, count);
  for (const int count : kVertexCounts) add(kVerticesKnob, count);
  for (const auto& [shape, kind] : kShapes)
    cases.push_back(CaseName{{kTao21SummaryScene}, {{kShapeKnob, std::string(shape)}}}.text());
  return cases;
}

std::vector<Record> measureTao21Curve(BenchRun& run, const std::string& case_name) {
  const CaseName name = CaseName::parse(case_name);
  Scene scene = openScene(run.session().common, name.word(0));
  const AreaLight lamp = scene.area_lights.front();
  if (name.value(kLightsKnob))
    scene.area_lights.assign(static_cast<std::size_t>(name.number(kLightsKnob)), lamp);
  else if (const auto shape = name.value(kShapeKnob))
    scene.area_lights = {roundLight(lamp, std::ranges::find(kShapes, *shape, [](const auto& s) {
                                            return std::string(s.first);
                                          })->second)};
  else
    scene.area_lights = {regularLight(lamp, static_cast<int>(name.number(kVerticesKnob)))};
  const auto renderer = preparedFrame(run, scene, scene.view(kCurveView), run.shading());
  return {run.record(tao21Spec(), case_name, "shading_ms", shadeTimesMs(*renderer, run.reps()),
                     "kernel events")};
}

}  // namespace glintmark
