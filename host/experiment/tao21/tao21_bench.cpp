// glintmark bench tao21: area lights on normal-mapped surfaces.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/experiment/all_tables.h"
#include "host/experiment/paper_gpu.h"
#include "host/experiment/summary_table.h"
#include "host/experiment/tao21/tao21_summary.h"
#include "host/experiment/tao21/tao21_table.h"
#include "host/experiment/tao21/tao21_view.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

// Micro roughness of Fig. 7, at one view.
constexpr const char* kRoughnessScene = "area_glass";
constexpr const char* kRoughnessView = "middle";
constexpr const char* kRoughnessKnob = "roughness";
constexpr double kRoughness[] = {0.03, 0.1, 0.3, 0.6};

std::vector<std::string> tao21Scenes() {
  return {"area_cloth", "area_knot", "area_glass", "area_shapes", kTao21SummaryScene};
}

std::vector<std::string> tao21Views() {
  return {"near", "middle", "far"};
}

// The cases of one view, a knob with each; none for no knob.
void addMethods(const CaseName& view, std::vector<std::string>& cases) {
  for (const std::string_view method : kTao21Methods)
    cases.push_back(tao21Case(view, method).text());
}

std::vector<std::string> viewCases(const BenchOptions& options) {
  std::vector<std::string> cases;
  for (const std::string& scene : selectNames(tao21Scenes(), options.scenes)) {
    if (scene == kTao21SummaryScene) continue;
    for (const std::string& view : selectNames(tao21Views(), options.views)) {
      addMethods({{scene, view}}, cases);
      if (scene != kRoughnessScene || view != kRoughnessView) continue;
      for (const double roughness : kRoughness)
        addMethods({{scene, view}, {{kRoughnessKnob, roughness}}}, cases);
    }
  }
  return cases;
}

// Measures views with all their methods at once, and hands out one method's records after another.
class ViewMeasurer {
 public:
  explicit ViewMeasurer(BenchRun& run) : run_(run) {}

  std::vector<Record> operator()(const std::string& name) {
    const CaseName wanted = CaseName::parse(name);
    const CaseName view{{wanted.word(0), wanted.word(1)}, wanted.knobs};
    if (view != measured_) {
      measure(view);
      measured_ = view;
    }
    return records_[wanted.word(2)];
  }

 private:
  // A view without its method, perhaps with a roughness.
  void measure(const CaseName& wanted) {
    Scene scene = openScene(run_.session().common, wanted.word(0));
    if (!wanted.knobs.empty()) {
      const auto roughness = static_cast<float>(wanted.number(kRoughnessKnob));
      for (Material& material : scene.materials)
        material.params.surface.alpha_g = {roughness, roughness};
    }
    Tao21View view = measureTao21View(run_, scene, scene.view(wanted.word(1)), wanted);
    run_.keepPicture(view.picture, fmt::format("{}_{}.png", tao21Spec().name, wanted.fileStem()));
    records_ = std::move(view.records);
  }

  BenchRun& run_;
  CaseName measured_;
  std::map<std::string, std::vector<Record>> records_;
};

void measure(BenchRun& run) {
  ViewMeasurer measurer(run);
  run.measureCases(tao21Spec().name, viewCases(run.options()), tao21Metrics(),
                   [&](const std::string& name) { return measurer(name); });
  const std::vector<std::string> scenes = selectNames(tao21Scenes(), run.options().scenes);
  if (std::ranges::find(scenes, kTao21SummaryScene) == scenes.end() || !run.options().views.empty())
    return;
  run.measureCases(tao21Spec().name, tao21CurveCases(), {"shading_ms"},
                   [&](const std::string& name) { return measureTao21Curve(run, name); });
  run.measureCases(tao21Spec().name, {kAllCase}, tao21SummaryMetrics(),
                   [&](const std::string&) { return measureTao21Summary(run); });
}

std::string text(const BenchRun& run) {
  const RunInfo& info = run.info();
  const std::vector<Record> records = run.recordsOf(tao21Spec().name);
  return fmt::format(
             "[TAO21] Figs. 5 to 7 at {}, {} lanes, {:.0f} GFLOP/s FMA peak (the paper's GTX 1070: "
             "{:.0f},\nboth methods {:.0f} ms a frame) on {:.60}\n\n",
             run.options().size, info.width, info.peak_gflops, kGtx1070PeakGflops, kTao21FrameMs,
             info.device) +
         tao21TableText(records) + tao21SummaryText(records) + invalidText(records);
}

}  // namespace

BenchTable tao21Bench() {
  return {tao21Spec(), tao21Scenes(), tao21Views(), measure, text};
}

}  // namespace glintmark
