#include "host/experiment/accuracy/accuracy_truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/experiment/frame_truth.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

double principal(PrincipalMetric metric, const Image& row, const Image& truth, double exposure) {
  if (metric == PrincipalMetric::kRelMse) return relMse(row, truth);
  return colourError(toneMap(row, {.exposure = exposure}), toneMap(truth, {.exposure = exposure}));
}

}  // namespace

std::string sampledTruthNote(const BenchRun& run, const SampledTruthSettings& settings,
                             const std::vector<std::string>& scenes) {
  const ImageSize size = truthSize(run, settings.width_px);
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
  const ImageSize size = truthSize(stage.run(), settings_.width_px);
  ShadingOptions options = stage.options();
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  return options;
}

const SampledSweep::Truth& SampledSweep::truth(std::size_t index, const AccuracyStage& stage) {
  const auto found = truths_.find(index);
  if (found != truths_.end()) return found->second;
  const TruthImages images = truthOf(stage.run(), stage.scene(), stage.view(), truthOptions(stage),
                                     settings_.spp, stage.textures());
  const Image off = oneErrorOff(images);
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
  // Samples that the truth has not used.
  return sampleFrame(*stage.sampler(options), settings_.spp, setting.samples).mean;
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
