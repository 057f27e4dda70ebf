#include "host/experiment/tao21/tao21_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiment/frame_timing.h"
#include "host/experiment/frame_truth.h"
#include "host/experiment/survival.h"
#include "host/experiment/tao21/tao21_table.h"
#include "host/report/metrics.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

struct MethodCase {
  LtcMethod method;
  std::string method_name, case_name;
};

// Those of a view in which no driver has died: the others are measured without them.
std::vector<MethodCase> casesLeft(const CaseName& view_name) {
  std::vector<MethodCase> cases;
  for (std::size_t m = 0; m < kTao21Methods.size(); ++m) {
    const std::string name = tao21Case(view_name, kTao21Methods[m]).text();
    if (!isLost(tao21Spec().name, name))
      cases.push_back({static_cast<LtcMethod>(m), std::string(kTao21Methods[m]), name});
  }
  return cases;
}

std::unique_ptr<FrameRenderer> methodFrame(BenchRun& run, const Scene& scene, const View& view,
                                           ShadingOptions options, const MethodCase& one) {
  const CaseAtHand at_hand(tao21Spec().name, one.case_name);
  options.ltc_method = one.method;
  return preparedFrame(run, scene, view, options);
}

// Kernel event times [ms] of every method, in turn.
std::vector<Samples> measureTimes(BenchRun& run, const Scene& scene, const View& view,
                                  const Tao21Settings& settings,
                                  const std::vector<MethodCase>& cases) {
  std::vector<std::unique_ptr<FrameRenderer>> renderers;
  renderers.reserve(cases.size());
  for (const MethodCase& one : cases)
    renderers.push_back(methodFrame(run, scene, view, settings.shading, one));
  return shadeInTurn(renderers, run.reps());
}

Image display(const Image& radiance, double exposure) {
  return toneMap(radiance, {.exposure = exposure});
}

}  // namespace

Tao21Settings tao21Settings(const BenchRun& run) {
  Tao21Settings settings;
  settings.shading = settings.errors = run.shading();
  const ImageSize size = truthSize(run, kTruthWidth_px);
  settings.errors.width_px = size.width_px;
  settings.errors.height_px = size.height_px;
  return settings;
}

const std::vector<std::string>& tao21Metrics() {
  static const std::vector<std::string> metrics = {"shading_ms", "rel_mse", "colour_error", "bias",
                                                   "truth_stderr"};
  return metrics;
}

CaseName tao21Case(const CaseName& view, std::string_view method) {
  CaseName name = view;
  name.words.emplace_back(method);
  return name;
}

Tao21View measureTao21View(BenchRun& run, const Scene& scene, const View& view,
                           const CaseName& view_name) {
  const Tao21Settings settings = tao21Settings(run);
  const std::vector<MethodCase> cases = casesLeft(view_name);
  const std::vector<Samples> times_ms = measureTimes(run, scene, view, settings, cases);
  const ShadingOptions& small = settings.errors;
  const ReplicatedTruth truth = truthOf(run, scene, view, small, settings.truth_spp);
  const Image& truth_image = truth.images.mean;
  const Image truth_row = coveredPixels(truth_image);
  const std::string truth_fault = radianceFault(truth_image);
  const bool truth_sane = truth_fault.empty();
  const double standard_error =
      truth_sane ? errorOfMean(truth_image, truth.replicates,
                               [](const Image& off, const Image& mean) {
                                 return relMse(coveredPixels(off), coveredPixels(mean));
                               })
                 : 0;

  Tao21View result;
  std::vector<std::pair<std::string, Image>> pictures;
  const double exposure = scene.post.exposure;
  const std::string size =
      fmt::format("at {}x{}, {} samples", small.width_px, small.height_px, settings.truth_spp);
  for (std::size_t m = 0; m < cases.size(); ++m) {
    const std::string& method = cases[m].method_name;
    const Image image = methodFrame(run, scene, view, small, cases[m])->readRadiance();
    const Image row = coveredPixels(image);
    const std::string fault = truth_sane ? radianceFault(image) : truth_fault;
    const bool sane = fault.empty();
    std::vector<Record>& records = result.records[method];
    const auto add = [&](const char* metric, const Samples& samples, const std::string& note) {
      records.push_back(run.record(tao21Spec(), cases[m].case_name, metric, samples, note));
      records.back().valid = sane;
      if (!sane) records.back().note = "not valid: " + fault;
    };
    add("shading_ms", times_ms[m], "kernel events, methods in turn");
    records.back().paper = kTao21FrameMs;
    add("rel_mse", {sane ? relMse(row, truth_row) : 0}, size);
    add("colour_error",
        {sane ? colourError(display(row, exposure), display(truth_row, exposure)) : 0}, size);
    add("bias", {sane ? relativeBias(row, truth_row) : 0}, "of the mean radiance");
    add("truth_stderr", {standard_error}, "as a relMSE");
    pictures.emplace_back(method, display(image, exposure));
  }
  pictures.emplace_back("truth", display(truth_image, exposure));
  result.picture = pictureStrip(pictures);
  return result;
}

}  // namespace glintmark
