#include "host/experiment/accuracy/accuracy_truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/experiment/tao21/tao21_view.h"
#include "host/frame/ground_truth.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

ImageSize truthSize(const BenchRun& run, const SampledTruthSettings& settings) {
  const ImageSize full = parseSize(run.options().size);
  ImageSize size;
  size.width_px = std::min(full.width_px, settings.width_px);
  size.height_px = std::max(1, full.height_px * size.width_px / full.width_px);
  return size;
}

double principal(PrincipalMetric metric, const Image& row, const Image& truth, double exposure) {
  if (metric == PrincipalMetric::kRelMse) return relMse(row, truth);
  return colourError(toneMap(row, {.exposure = exposure}), toneMap(truth, {.exposure = exposure}));
}

}  // namespace

std::string sampledTruthNote(const BenchRun& run, const SampledTruthSettings& settings,
                             const std::vector<std::string>& scenes) {
  const ImageSize size = truthSize(run, settings);
  return fmt::format("error: {} at {}x{} against {} samples a pixel, geometric mean over {}",
                     settings.metric == PrincipalMetric::kRelMse ? "relMSE" : "colour error",
                     size.width_px, size.height_px, settings.spp, fmt::join(scenes, ", "));
}

SampledSweep::SampledSweep(BenchRun& run, const std::string& effect,
                           const std::vector<std::string>& scenes,
                           std::vector<AccuracySetting> settings, const SampledTruthSettings& truth)
    : AccuracySweep(run, effect, scenes, std::move(settings),
                    {sampledTruthNote(run, truth, scenes),
                     "kernel events at the command line's size, in turn with the default"}),
      settings_(truth) {}

ShadingOptions SampledSweep::truthOptions(const AccuracyStage& stage) const {
  const ImageSize size = truthSize(stage.run(), settings_);
  ShadingOptions options = stage.options();
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  return options;
}

const SampledSweep::Truth& SampledSweep::truth(std::size_t index, const AccuracyStage& stage) {
  const auto found = truths_.find(index);
  if (found != truths_.end()) return found->second;
  const TruthImages images = renderTruth(
      stage.run().device(), stage.scene(), stage.view(), truthOptions(stage), settings_.spp,
      [](int) { stopIfInterrupted(); }, stage.run().session().common.threads, stage.textures());
  Image off = images.mean;
  for (std::size_t i = 0; i < off.pixels.size() / 4; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      off.pixels[4 * i + c] += images.standard_error.pixels[3 * i + c];
  Truth made;
  made.row = coveredPixels(images.mean);
  made.sane = isSane(images.mean) && isSane(off) && !made.row.pixels.empty();
  if (made.sane)
    made.standard_error =
        principal(settings_.metric, coveredPixels(off), made.row, stage.scene().post.exposure);
  return truths_.emplace(index, std::move(made)).first->second;
}

Image SampledSweep::image(const AccuracyStage& stage, const AccuracySetting& setting) const {
  ShadingOptions options = truthOptions(stage);
  if (setting.samples == 0) {
    if (setting.apply) setting.apply(options);
    return stage.renderer(options)->readRadiance();
  }
  const auto sampled = stage.sampler(options);
  const auto samples = static_cast<std::uint32_t>(setting.samples);
  // Samples that the truth has not used.
  sampled->addSamples(static_cast<std::uint32_t>(settings_.spp), samples);
  return sampled->readMean(samples);
}

AccuracyFigures SampledSweep::figures(std::size_t index, const AccuracyStage& stage,
                                      const AccuracySetting& setting) {
  const Truth& right = truth(index, stage);
  const Image frame = image(stage, setting);
  AccuracyFigures figures;
  figures.truth_stderr = right.standard_error;
  if (!right.sane || !isSane(frame)) {
    figures.failure = stage.name() + ": radiance is negative, not finite or missing";
    return figures;
  }
  const Image row = coveredPixels(frame);
  const double exposure = stage.scene().post.exposure;
  figures.error = principal(settings_.metric, row, right.row, exposure);
  figures.bias = relativeBias(row, right.row);
  figures.rel_mse = relMse(row, right.row);
  figures.colour_error = principal(PrincipalMetric::kColourError, row, right.row, exposure);
  return figures;
}

}  // namespace glintmark
