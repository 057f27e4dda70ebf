// glintmark bench tan05: the comparisons of [TAN05] over scenes, views, distances and methods; a
// strip of pictures per view.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "host/experiment/all_tables.h"
#include "host/experiment/summary_table.h"
#include "host/experiment/tan05/tan05_summary.h"
#include "host/experiment/tan05/tan05_table.h"
#include "host/experiment/tan05/tan05_view.h"
#include "host/frame/effect/normal_maps.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr const char* kSummaryScene = "disk";
constexpr int kDistanceSize_px = 250;
// Of the truth at a distance, where errors of methods lie close together.
constexpr int kDistanceTruthSpp = 256;

std::vector<std::string> tan05Scenes() {
  return {"disk", "armour", "desert"};
}

std::vector<std::string> tan05Views() {
  return {"near", "far", "oblique"};
}

std::vector<std::string> distanceViews() {
  std::vector<std::string> views;
  for (const double distance : kTan05Distances) views.push_back(tan05DistanceView(distance));
  return views;
}

std::vector<std::string> allViews() {
  std::vector<std::string> views = tan05Views();
  for (std::string& view : distanceViews()) views.push_back(std::move(view));
  return views;
}

bool hasView(const std::string& scene, const std::string& view) {
  return view != "oblique" || scene == "disk";
}

using MethodsByScene = std::map<std::string, std::vector<Tan05Method>>;

// Of each scene; says which it has to leave out. As they ship, scenes go with every method.
MethodsByScene methodsByScene(const BenchRun& run) {
  MethodsByScene methods;
  CommonOptions quiet = run.session().common;
  quiet.quiet = true;
  for (const std::string& name : selectNames(tan05Scenes(), run.options().scenes)) {
    std::vector<Tan05Method>& own = methods[name] = tan05Methods();
    if (quiet.overrides.empty()) continue;
    own = tan05MethodsOf(openScene(quiet, name));
    if (own.size() < tan05Methods().size() && !run.session().common.quiet)
      fmt::print(stderr, "{}\n", withoutAnisotropicNote(name));
  }
  return methods;
}

std::vector<std::string> viewCases(const BenchOptions& options, const MethodsByScene& methods) {
  std::vector<std::string> cases;
  for (const std::string& scene : selectNames(tan05Scenes(), options.scenes))
    for (const std::string& view : selectNames(tan05Views(), options.views))
      if (hasView(scene, view))
        for (const Tan05Method& method : methods.at(scene))
          cases.push_back(CaseName{{scene, view, method.name}}.text());
  return cases;
}

std::vector<std::string> distanceCases(const BenchOptions& options, const MethodsByScene& methods) {
  std::vector<std::string> cases;
  for (const std::string& scene : selectNames(tan05Scenes(), options.scenes))
    for (const std::string& view : selectNames(distanceViews(), options.views))
      for (const Tan05Method& method : methods.at(scene))
        cases.push_back(CaseName{{scene, view, method.name}}.text());
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
    const CaseName wanted = CaseName::parse(name);
    const std::string& view_name = wanted.word(1);
    measureOnce(wanted, [&](const Tan05Scene& loaded) {
      const View& view = loaded.scene.view(view_name);
      Tan05View measured = measureTan05View(run_, loaded, view, tan05Settings(run_));
      run_.keepPicture(measured.picture,
                       fmt::format("{}_{}.png", tan05Spec().name,
                                   CaseName{{wanted.word(0), view_name}}.fileStem()));
      return measured;
    });
    return view_.records[wanted.word(2)];
  }

  std::vector<Record> distance(const std::string& name) {
    const CaseName wanted = CaseName::parse(name);
    measureOnce(wanted, [&](const Tan05Scene& loaded) {
      Tan05Settings settings = tan05Settings(run_);
      // Half the paper's size and half the distance: the same texels per pixel.
      settings.shading.width_px = settings.shading.height_px = kDistanceSize_px;
      settings.truth_spp = kDistanceTruthSpp;
      const double factor = tan05DistanceOf(wanted.word(1)).value();
      const View moved =
          atDistance(loaded.scene.view(std::string(kTan05DistanceBase)), 0.5 * factor);
      return measureTan05Distance(run_, loaded, moved, wanted.word(1), settings);
    });
    return view_.records[wanted.word(2)];
  }

 private:
  // Keeps what `measure` gives of a view until another is wanted.
  template <typename Measure>
  void measureOnce(const CaseName& wanted, Measure measure) {
    const CaseName view{{wanted.word(0), wanted.word(1)}};
    if (view == measured_) return;
    view_ = measure(scene(wanted.word(0)));
    measured_ = view;
  }

  BenchRun& run_;
  std::optional<Tan05Scene> scene_;
  CaseName measured_;
  Tan05View view_;
};

void measure(BenchRun& run) {
  ViewMeasurer measurer(run);
  const MethodsByScene methods = methodsByScene(run);
  run.measureCases(tan05Spec().name, viewCases(run.options(), methods), tan05ViewMetrics(),
                   [&](const std::string& name) { return measurer.view(name); });
  run.measureCases(tan05Spec().name, distanceCases(run.options(), methods), tan05DistanceMetrics(),
                   [&](const std::string& name) { return measurer.distance(name); });
  if (!run.options().views.empty()) return;
  const std::vector<std::string> scenes = selectNames(tan05Scenes(), run.options().scenes);
  if (std::ranges::find(scenes, kSummaryScene) == scenes.end()) return;
  run.measureCases(tan05Spec().name, tan05KnobCases(), tan05KnobMetrics(),
                   [&](const std::string& name) {
                     return measureTan05Knob(run, measurer.scene(kSummaryScene), name);
                   });
  run.measureCases(tan05Spec().name, {kAllCase}, tan05SummaryMetrics(), [&](const std::string&) {
    return measureTan05Summary(run, measurer.scene(kSummaryScene));
  });
}

std::string text(const BenchRun& run) {
  const RunInfo& info = run.info();
  const std::vector<Record> records = run.recordsOf(tan05Spec().name);
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
  return {tan05Spec(), tan05Scenes(), allViews(), measure, text};
}

}  // namespace glintmark
