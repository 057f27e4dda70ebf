// glintmark bench glints: every method, side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/experiment/accuracy/glint_judge.h"
#include "host/experiment/all_tables.h"
#include "host/experiment/count_cells.h"
#include "host/experiment/frame_timing.h"
#include "host/experiment/glints/glints_plane.h"
#include "host/experiment/glints/glints_table.h"
#include "host/ocl/static_counts.h"
#include "host/ocl/switches.h"
#include "host/parallel/ranks.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

// Pixels a side of the lattices that errors are of, and most microdetails that are placed for a
// truth: a second on two cores. Beyond it truths are drawn.
constexpr int kErrorSide = 16;
constexpr double kErrorDetails = 4e7;
// Frames are repeated until they have taken a while, and so often at least.
constexpr int kLeastRounds = 3;
constexpr double kAsFast = 1.05;

const std::vector<std::string>& measuredMetrics() {
  static const std::vector<std::string> metrics = {"ns_per_px", "visited_mean", "ns_per_visited",
                                                   "limited_share"};
  return metrics;
}

class GlintsMeasurement {
 public:
  explicit GlintsMeasurement(BenchRun& run)
      : run_(run),
        judge_(
            run.device(), run.cache(), run.info().width, kErrorSide,
            [](const std::string&) { stopIfInterrupted(); }, kErrorDetails) {}

  std::vector<Record> measure(const std::string& method, const GlintsKind& kind);

 private:
  void addTimes(FrameRenderer& glints, FrameRenderer& smooth, const CountedCells& counted);
  void addStaticCounts(const FrameRenderer& glints);
  void addErrors(const KernelConfig& config, const GlintStage& stage);
  void add(const std::string& metric, const Samples& samples, const std::string& note = "") {
    records_.push_back(run_.record(glintsSpec(), case_, metric, samples, note));
  }

  BenchRun& run_;
  GlintJudge judge_;
  std::string case_;
  std::vector<Record> records_;
};

void GlintsMeasurement::addTimes(FrameRenderer& glints, FrameRenderer& smooth,
                                 const CountedCells& counted) {
  const auto pixels = static_cast<double>(counted.counts.glint_px);
  const double visited = counted.counts.mean;
  Samples per_px, per_visited;
  const TurnTimes times = shadeInTurn(
      glints, smooth, lastingReps(glints, smooth, std::min(run_.options().reps, kLeastRounds)));
  const double without_ms = *std::ranges::min_element(times.second_ms);
  for (const double ms : times.first_ms) {
    per_px.push_back((ms - without_ms) / kMsPerNs / pixels);
    per_visited.push_back(per_px.back() / visited);
  }
  add("ns_per_px", per_px, "frames with glints minus the fastest without, in turn");
  add("visited_mean", {visited});
  add("ns_per_visited", per_visited);
  add("limited_share", {static_cast<double>(counted.counts.guard_hits) / pixels});
}

void GlintsMeasurement::addStaticCounts(const FrameRenderer& glints) {
  const auto config = std::ranges::find_if(glints.configs(), &KernelConfig::glint);
  if (config == glints.configs().end()) return;
  const std::optional<StaticCounts> counts =
      staticCounts(run_.cache().get("shade.cl", *config), "shade");
  if (!counts) return;
  add("kernel_instructions", {static_cast<double>(counts->kernel_instructions)},
      fmt::format("machine instructions of the compiled kernel, {} lanes", config->width));
  add("vector_512", {static_cast<double>(counts->vector_512)});
}

void GlintsMeasurement::addErrors(const KernelConfig& config, const GlintStage& stage) {
  const std::size_t index = glintStageOf(glintStageCase("glints", stage));
  KernelConfig ratios;
  ratios.width = config.width;
  ratios.method = config.method;
  ratios.size_variation = false;
  const GlintFigures figures = judge_.method(ratios, index, false);
  if (!figures.sane) {
    add("error", {NAN}, "not valid: a ratio is negative or not finite");
    records_.back().valid = false;
    return;
  }
  add("error", {figures.error}, fmt::format("{} x {} pixels a lattice", kErrorSide, kErrorSide));
  add("variance_ratio", {figures.variance_ratio.mean()});
  add("bias", {figures.mean.mean() - 1});
}

std::vector<Record> GlintsMeasurement::measure(const std::string& method, const GlintsKind& kind) {
  case_ = glintsCase(method, kind);
  records_.clear();
  const Scene scene = glintPlane(kind.stage, kind.lights, run_.size().height_px);
  const View& view = scene.views.front();
  ShadingOptions options = run_.shading();
  options.method = parseMethod(method);
  ShadingOptions smooth_options = options;
  smooth_options.glints = false;
  const auto glints = preparedFrame(run_, scene, view, options);
  const auto smooth = preparedFrame(run_, scene, view, smooth_options);
  const CountedCells counted = countCells(run_.device(), scene, view, options, run_.threads());
  addTimes(*glints, *smooth, counted);
  addStaticCounts(*glints);
  if (kind.lights == 1) addErrors(glints->configs().front(), kind.stage);
  invalidateIfFaulty(records_, glints->readRadiance());
  return records_;
}

// Errors over those of methods that are as fast, where all of a kind are there.
void addComparisons(BenchRun& run) {
  const std::vector<Record> all = run.recordsOf(glintsSpec().name);
  std::vector<Record> derived;
  const auto find = [&](const std::string& case_name, std::string_view metric) {
    return std::ranges::find_if(all, [&](const Record& record) {
      return record.case_ == case_name && record.metric == metric && record.valid;
    });
  };
  for (const Record& error : all) {
    if (error.metric != "error" || !error.valid) continue;
    const auto time = find(error.case_, "ns_per_px");
    if (time == all.end()) continue;
    double least = error.value.median;
    const std::string kind = CaseName::parse(error.case_).rest().text();
    for (const Record& other : all) {
      if (other.metric != "error" || !other.valid ||
          CaseName::parse(other.case_).rest().text() != kind)
        continue;
      const auto other_time = find(other.case_, "ns_per_px");
      if (other_time != all.end() && other_time->value.min <= kAsFast * time->value.min)
        least = std::min(least, other.value.median);
    }
    derived.push_back(run.record(glintsSpec(), error.case_, "error_over_best",
                                 {error.value.median / least}, "times by their least"));
  }
  run.addDerived(derived);
}

std::string viewOf(const GlintsKind& kind) {
  return fmt::format("aspect{}", kind.stage.aspect);
}

std::vector<std::string> glintsViews() {
  std::vector<std::string> views;
  for (const GlintsKind& kind : glintsKinds())
    if (std::ranges::find(views, viewOf(kind)) == views.end()) views.push_back(viewOf(kind));
  return views;
}

void measure(BenchRun& run) {
  const std::vector<std::string> views = selectNames(glintsViews(), run.options().views);
  std::vector<std::string> cases;
  std::vector<std::pair<std::string, GlintsKind>> what;
  for (const GlintsKind& kind : glintsKinds()) {
    if (std::ranges::find(views, viewOf(kind)) == views.end()) continue;
    for (const std::string& method : namesOf<GlintMethod>()) {
      cases.push_back(glintsCase(method, kind));
      what.emplace_back(method, kind);
    }
  }
  GlintsMeasurement measurement(run);
  run.measureCases(glintsSpec().name, cases, measuredMetrics(), [&](const std::string& name) {
    const auto index = static_cast<std::size_t>(std::ranges::find(cases, name) - cases.begin());
    return measurement.measure(what[index].first, what[index].second);
  });
  if (!allRanks().isFirst()) return;
  addComparisons(run);
}

std::string text(const BenchRun& run) {
  const std::vector<Record> records = run.recordsOf(glintsSpec().name);
  return fmt::format("Methods of glints on a plane at {}, {} lanes\non {:.90}\n\n",
                     run.options().size, run.info().width, run.info().device) +
         glintsTableText(records) + "\n" + glintsClaimsText(records) + invalidText(records);
}

}  // namespace

BenchTable glintsBench() {
  return {glintsSpec(), {"plane"}, glintsViews(), measure, text};
}

}  // namespace glintmark
