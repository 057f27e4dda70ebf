#include "host/experiment/tan05/tan05_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "host/experiment/tan05/tan05_summary.h"
#include "host/experiment/tan05/tan05_table.h"
#include "host/experiment/tan05/tan05_view.h"
#include "host/report/picture/image_io.h"

namespace glintmark {
namespace {

constexpr const char* kTable = "tan05";
constexpr const char* kSummaryScene = "disk";
constexpr const char* kDistanceView = "near";
constexpr int kDistanceSize_px = 250;
// Of the truth at a distance, where errors of methods lie close together.
constexpr int kDistanceTruthSpp = 256;

std::vector<std::string> knownScenes() {
  return {"disk", "armour", "desert"};
}

std::vector<std::string> knownViews() {
  return {kDistanceView, "far", "oblique"};
}

bool hasView(const std::string& scene, const std::string& view) {
  return view != "oblique" || scene == "disk";
}

// "scene/view/method".
struct CaseName {
  std::string scene, view, method;

  explicit CaseName(const std::string& name) {
    const std::size_t first = name.find('/'), last = name.rfind('/');
    scene = name.substr(0, first);
    view = name.substr(first + 1, last - first - 1);
    method = name.substr(last + 1);
  }
};

std::vector<std::string> viewCases(const BenchOptions& options) {
  std::vector<std::string> cases;
  for (const std::string& scene : selectNames(knownScenes(), options.scenes))
    for (const std::string& view : selectNames(knownViews(), options.views))
      if (hasView(scene, view))
        for (const Tan05Method& method : tan05Methods())
          cases.push_back(fmt::format("{}/{}/{}", scene, view, method.name));
  return cases;
}

std::vector<std::string> distanceCases(const BenchOptions& options) {
  std::vector<std::string> cases;
  for (const std::string& scene : selectNames(knownScenes(), options.scenes))
    for (const int distance : kTan05Distances)
      for (const Tan05Method& method : tan05Methods())
        cases.push_back(fmt::format("{}/{}_{}/{}", scene, kDistanceView, distance, method.name));
  return cases;
}

// Keeps the scene that was asked for last, and measures its views with all methods at once.
class ViewMeasurer {
 public:
  explicit ViewMeasurer(BenchRun& run) : run_(run) {}

  const Tan05Scene& scene(const std::string& name) {
    if (!scene_ || scene_->scene.name != name) scene_.emplace(run_, name);
    return *scene_;
  }

  std::vector<Record> view(const std::string& name) {
    const CaseName wanted(name);
    const std::string key = wanted.scene + "/" + wanted.view;
    if (key != measured_) {
      const Tan05Scene& loaded = scene(wanted.scene);
      view_ = measureTan05View(run_, loaded, loaded.scene.view(wanted.view), tan05Settings(run_));
      writePng(view_.picture,
               run_.folder() / fmt::format("tan05_{}_{}.png", wanted.scene, wanted.view));
      measured_ = key;
    }
    return view_.records[wanted.method];
  }

  std::vector<Record> distance(const std::string& name) {
    const CaseName wanted(name);
    const std::string key = wanted.scene + "/" + wanted.view;
    if (key != measured_) {
      int factor = 1;
      const char* digits = wanted.view.data() + wanted.view.find('_') + 1;
      std::from_chars(digits, wanted.view.data() + wanted.view.size(), factor);
      const Tan05Scene& loaded = scene(wanted.scene);
      Tan05Settings settings = tan05Settings(run_);
      // Half the paper's size and half the distance: the same texels per pixel.
      settings.shading.width_px = settings.shading.height_px = kDistanceSize_px;
      settings.truth_spp = kDistanceTruthSpp;
      const View moved = atDistance(loaded.scene.view(kDistanceView), 0.5 * factor);
      view_ = measureTan05Distance(run_, loaded, moved, wanted.view, settings);
      measured_ = key;
    }
    return view_.records[wanted.method];
  }

 private:
  BenchRun& run_;
  std::optional<Tan05Scene> scene_;
  std::string measured_;
  Tan05View view_;
};

void measure(BenchRun& run) {
  ViewMeasurer measurer(run);
  run.measureCases(kTable, viewCases(run.options()), tan05ViewMetrics(),
                   [&](const std::string& name) { return measurer.view(name); });
  if (!run.options().views.empty()) return;
  run.measureCases(kTable, distanceCases(run.options()), tan05DistanceMetrics(),
                   [&](const std::string& name) { return measurer.distance(name); });
  const std::vector<std::string> scenes = selectNames(knownScenes(), run.options().scenes);
  if (std::ranges::find(scenes, kSummaryScene) == scenes.end()) return;
  run.measureCases(kTable, tan05KnobCases(), tan05KnobMetrics(), [&](const std::string& name) {
    return measureTan05Knob(run, measurer.scene(kSummaryScene), name);
  });
  run.measureCases(kTable, {"all"}, tan05SummaryMetrics(), [&](const std::string&) {
    return measureTan05Summary(run, measurer.scene(kSummaryScene));
  });
}

std::string text(const BenchRun& run) {
  const RunInfo& info = run.info();
  const std::vector<Record> records = run.recordsOf(kTable);
  std::string result = fmt::format(
      "[TAN05] Figs. 4, 7 and 8 at 500x500, knobs and ratios at {}, {} lanes, {:.0f} GFLOP/s\non "
      "{:.90}\n\n",
      run.options().size, info.width, info.peak_gflops, info.device);
  for (const std::string& part :
       {tan05TableText(records), tan05DistanceText(records), tan05SummaryText(records)})
    if (!part.empty()) result += part + "\n";
  return result + invalidText(records);
}

}  // namespace

BenchTable tan05Bench() {
  return {kTable, knownScenes(), knownViews(), measure, text};
}

}  // namespace glintmark
