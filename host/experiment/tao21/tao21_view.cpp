#include "host/experiment/tao21/tao21_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/statistics.h"
#include "host/experiment/tao21/tao21_table.h"
#include "host/frame/ground_truth.h"
#include "host/report/metrics.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

constexpr double kMsPerNs = 1e-6;
constexpr int kMethodCount = static_cast<int>(kTao21Methods.size());

ShadingOptions methodOptions(ShadingOptions options, int method) {
  options.ltc_method = static_cast<LtcMethod>(method);
  return options;
}

// Kernel event times [ms] of every method, in turn.
std::vector<std::vector<double>> measureTimes(BenchRun& run, const Scene& scene, const View& view,
                                              const Tao21Settings& settings) {
  std::vector<std::unique_ptr<FrameRenderer>> renderers;
  for (int m = 0; m < kMethodCount; ++m) {
    renderers.push_back(std::make_unique<FrameRenderer>(
        run.device(), scene, view, methodOptions(settings.shading, m), settings.threads));
    renderers.back()->prepare();
    renderers.back()->shade();
  }
  std::vector<std::vector<double>> times_ms(kMethodCount);
  for (int rep = 0; rep < settings.reps; ++rep)
    for (std::size_t m = 0; m < renderers.size(); ++m) {
      times_ms[m].push_back(shadeMs(*renderers[m]));
    }
  return times_ms;
}

Image display(const Image& radiance, double exposure) {
  return toneMap(radiance, {.exposure = exposure});
}

double meanOf(const Image& image) {
  double sum = 0;
  for (const float value : image.pixels) sum += value;
  return image.pixels.empty() ? 0 : sum / static_cast<double>(image.pixels.size());
}

// The truth's RGB channels, or its errors, where the frame covers something.
Image coveredOf(const Image& image, const Image& coverage) {
  std::vector<float> values;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < coverage.pixels.size() / 4; ++i)
    for (std::size_t c = 0; coverage.pixels[4 * i + 3] > 0 && c < 3; ++c)
      values.push_back(image.pixels[channels * i + c]);
  Image row(static_cast<int>(values.size() / 3), 1, 3);
  row.pixels = std::move(values);
  return row;
}

}  // namespace

Image coveredPixels(const Image& image) {
  return coveredOf(image, image);
}

bool isSane(const Image& image) {
  return std::ranges::all_of(image.pixels, [](float v) { return std::isfinite(v) && v >= 0; });
}

double shadeMs(FrameRenderer& renderer) {
  stopIfInterrupted();
  return renderer.shade().shading_event_ns * kMsPerNs;
}

Tao21Settings tao21Settings(const BenchRun& run) {
  const ImageSize size = parseSize(run.options().size);
  Tao21Settings settings;
  settings.shading = {
      .width_px = size.width_px, .height_px = size.height_px, .lanes = run.info().width};
  settings.truth_size.width_px = std::min(size.width_px, kTruthWidth_px);
  settings.truth_size.height_px =
      std::max(1, size.height_px * settings.truth_size.width_px / size.width_px);
  settings.reps = run.options().reps;
  settings.threads = run.session().common.threads;
  return settings;
}

const std::vector<std::string>& tao21Metrics() {
  static const std::vector<std::string> metrics = {"shading_ms", "rel_mse", "colour_error", "bias",
                                                   "truth_stderr"};
  return metrics;
}

Record tao21Record(const BenchRun& run, const std::string& case_name, const std::string& metric,
                   const std::string& unit, const std::vector<double>& samples,
                   const std::string& note) {
  return run.record("tao21", case_name, metric, unit, samples, note);
}

Tao21View measureTao21View(BenchRun& run, const Scene& scene, const View& view,
                           const Tao21Settings& settings, const std::string& suffix) {
  const std::vector<std::vector<double>> times_ms = measureTimes(run, scene, view, settings);
  ShadingOptions small = settings.shading;
  small.width_px = settings.truth_size.width_px;
  small.height_px = settings.truth_size.height_px;
  const TruthImages truth = renderTruth(
      run.device(), scene, view, small, settings.truth_spp, [](int) { stopIfInterrupted(); },
      settings.threads);
  const Image truth_row = coveredPixels(truth.mean);
  const double truth_mean = meanOf(truth_row);
  const double standard_error =
      truth_mean > 0 ? meanOf(coveredOf(truth.standard_error, truth.mean)) / truth_mean : 0;

  Tao21View result;
  std::vector<std::pair<std::string, Image>> pictures;
  const double exposure = scene.post.exposure;
  const std::string size =
      fmt::format("at {}x{}, {} samples", small.width_px, small.height_px, settings.truth_spp);
  for (int m = 0; m < kMethodCount; ++m) {
    const std::string method(kTao21Methods[static_cast<std::size_t>(m)]);
    FrameRenderer renderer(run.device(), scene, view, methodOptions(small, m), settings.threads);
    renderer.prepare();
    renderer.shade();
    const Image image = renderer.readRadiance();
    const Image row = coveredPixels(image);
    const bool sane = isSane(image) && isSane(truth.mean) && !truth_row.pixels.empty();
    const std::string name = scene.name + "/" + view.name + "/" + method + suffix;
    std::vector<Record>& records = result.records[method];
    const auto add = [&](const char* metric, const char* unit, std::vector<double> samples,
                         const std::string& note) {
      records.push_back(tao21Record(run, name, metric, unit, samples, note));
      records.back().valid = sane;
      if (!sane) records.back().note = "not valid: radiance is negative, not finite or missing";
    };
    add("shading_ms", "ms", times_ms[static_cast<std::size_t>(m)],
        "kernel events, methods in turn");
    records.back().paper = kTao21FrameMs;
    add("rel_mse", "1", {sane ? relMse(row, truth_row) : 0}, size);
    add("colour_error", "1",
        {sane ? colourError(display(row, exposure), display(truth_row, exposure)) : 0}, size);
    add("bias", "1", {sane ? relativeBias(row, truth_row) : 0}, "of the mean radiance");
    add("truth_stderr", "1", {standard_error}, "mean over the mean radiance");
    pictures.emplace_back(method, display(image, exposure));
  }
  pictures.emplace_back("truth", display(truth.mean, exposure));
  result.picture = pictureStrip(pictures);
  return result;
}

}  // namespace glintmark
