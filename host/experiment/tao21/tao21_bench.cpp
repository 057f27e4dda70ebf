#include "host/experiment/tao21/tao21_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/experiment/tao21/tao21_summary.h"
#include "host/experiment/tao21/tao21_table.h"
#include "host/experiment/tao21/tao21_view.h"
#include "host/report/picture/image_io.h"

namespace glintmark {
namespace {

constexpr const char* kTable = "tao21";
constexpr const char* kSummaryScene = "area_plane";
// Micro roughness of Fig. 7, at one view.
constexpr const char* kRoughnessScene = "area_glass";
constexpr const char* kRoughnessView = "middle";
constexpr double kRoughness[] = {0.03, 0.1, 0.3, 0.6};

std::vector<std::string> knownScenes() {
  return {"area_cloth", "area_knot", "area_glass", kSummaryScene};
}

std::vector<std::string> knownViews() {
  return {"near", "middle", "far"};
}

// "scene/view/method" and perhaps "/roughness=R".
struct CaseName {
  std::string scene, view, method, suffix;

  explicit CaseName(const std::string& name) {
    const std::size_t first = name.find('/'), second = name.find('/', first + 1);
    const std::size_t third = std::min(name.find('/', second + 1), name.size());
    scene = name.substr(0, first);
    view = name.substr(first + 1, second - first - 1);
    method = name.substr(second + 1, third - second - 1);
    suffix = name.substr(third);
  }
};

void addMethods(const std::string& view, const std::string& suffix,
                std::vector<std::string>& cases) {
  for (const std::string_view method : kTao21Methods)
    cases.push_back(fmt::format("{}/{}{}", view, method, suffix));
}

std::vector<std::string> viewCases(const BenchOptions& options) {
  std::vector<std::string> cases;
  for (const std::string& scene : selectNames(knownScenes(), options.scenes)) {
    if (scene == kSummaryScene) continue;
    for (const std::string& view : selectNames(knownViews(), options.views)) {
      addMethods(scene + "/" + view, "", cases);
      if (scene != kRoughnessScene || view != kRoughnessView) continue;
      for (const double roughness : kRoughness)
        addMethods(scene + "/" + view, fmt::format("/roughness={}", roughness), cases);
    }
  }
  return cases;
}

// Measures views with all their methods at once, and hands out one method's records after another.
class ViewMeasurer {
 public:
  explicit ViewMeasurer(BenchRun& run) : run_(run) {}

  std::vector<Record> operator()(const std::string& name) {
    const CaseName wanted(name);
    const std::string view = wanted.scene + "/" + wanted.view + wanted.suffix;
    if (view != measured_) {
      measure(wanted);
      measured_ = view;
    }
    return records_[wanted.method];
  }

 private:
  void measure(const CaseName& wanted) {
    Scene scene = openScene(run_.session().common, wanted.scene);
    std::string file = fmt::format("tao21_{}_{}", wanted.scene, wanted.view);
    if (!wanted.suffix.empty()) {
      const std::string value = wanted.suffix.substr(wanted.suffix.find('=') + 1);
      for (Material& material : scene.materials)
        material.params.surface.alpha_g = {std::stof(value), std::stof(value)};
      file += "_roughness_" + value;
    }
    Tao21View view =
        measureTao21View(run_, scene, scene.view(wanted.view), tao21Settings(run_), wanted.suffix);
    writePng(view.picture, run_.folder() / (file + ".png"));
    records_ = std::move(view.records);
  }

  BenchRun& run_;
  std::string measured_;
  std::map<std::string, std::vector<Record>> records_;
};

void measure(BenchRun& run) {
  ViewMeasurer measurer(run);
  run.measureCases(kTable, viewCases(run.options()), tao21Metrics(),
                   [&](const std::string& name) { return measurer(name); });
  const std::vector<std::string> scenes = selectNames(knownScenes(), run.options().scenes);
  if (std::ranges::find(scenes, kSummaryScene) == scenes.end() || !run.options().views.empty())
    return;
  run.measureCases(kTable, tao21CurveCases(), {"shading_ms"},
                   [&](const std::string& name) { return measureTao21Curve(run, name); });
  run.measureCases(kTable, {"all"}, tao21SummaryMetrics(),
                   [&](const std::string&) { return measureTao21Summary(run); });
}

std::string text(const BenchRun& run) {
  const RunInfo& info = run.info();
  const std::vector<Record> records = run.recordsOf(kTable);
  return fmt::format(
             "[TAO21] Figs. 5 to 7 at {}, {} lanes, {:.0f} GFLOP/s FMA peak (the paper's GTX 1070: "
             "{:.0f},\nboth methods {:.0f} ms a frame) on {:.60}\n\n",
             run.options().size, info.width, info.peak_gflops, kGtx1070PeakGflops, kTao21FrameMs,
             info.device) +
         tao21TableText(records) + "\n" + tao21SummaryText(records) + invalidText(records);
}

}  // namespace

BenchTable tao21Bench() {
  return {kTable, knownScenes(), knownViews(), measure, text};
}

}  // namespace glintmark
