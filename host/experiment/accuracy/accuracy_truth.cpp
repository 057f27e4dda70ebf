#include "host/experiment/accuracy/accuracy_truth.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/experiment/accuracy/scene_table.h"
#include "host/experiment/shifted_view.h"
#include "host/parallel/ranks.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

constexpr const char* kSampledTimeNote =
    "kernel events at the command line's size, in turn with the default";

double principal(PrincipalMetric metric, const Image& row, const Image& truth, double exposure) {
  if (metric == PrincipalMetric::kRelMse) return relMse(row, truth);
  return colourError(toneMap(row, {.exposure = exposure}), toneMap(truth, {.exposure = exposure}));
}

}  // namespace

std::string sampledTruthNote(const BenchRun& run, const SampledTruthSettings& settings) {
  const ImageSize size = truthSize(run, settings.width_px);
  return fmt::format("error: {} at {}x{} against {} samples a pixel{}",
                     settings.metric == PrincipalMetric::kRelMse ? "relMSE" : "colour error",
                     size.width_px, size.height_px, settings.spp,
                     settings.shifts == 1 ? ""
                                          : fmt::format(", mean over {} shifts by parts of a pixel",
                                                        settings.shifts));
}

SampledSweep::SampledSweep(BenchRun& run, const std::string& effect,
                           const std::vector<std::string>& scenes,
                           std::vector<AccuracySetting> settings, const SampledTruthSettings& truth)
    : AccuracySweep(run, effect, scenes, std::move(settings),
                    {fmt::format("{}, geometric mean over {}", sampledTruthNote(run, truth),
                                 fmt::join(scenes, ", ")),
                     kSampledTimeNote}),
      settings_(truth) {}

std::vector<std::string> SampledSweep::closerCases() const {
  std::vector<std::string> cases;
  if (scenes().size() < 2) return cases;
  for (const std::string& scene : scenes())
    for (const AccuracySetting& setting : settings())
      cases.push_back(accuracyCase(effect() + "/" + scene, setting.name));
  return cases;
}

std::vector<Record> SampledSweep::measureCloser(const std::string& case_name) {
  for (std::size_t i = 0; i < scenes().size(); ++i)
    for (const AccuracySetting& setting : settings())
      if (accuracyCase(effect() + "/" + scenes()[i], setting.name) == case_name) {
        StageMeasured measured = measuredStages(setting)[i];
        measured.times.fit_ratio.clear();  // stands with the setting's case
        return accuracyRecords(run(), case_name, setting.role, measured.figures, measured.times,
                               {sampledTruthNote(run(), settings_), kSampledTimeNote});
      }
  return AccuracySweep::measureCloser(case_name);
}

std::string SampledSweep::closerText(std::span<const Record> records) const {
  return accuracySceneText(records, effect());
}

ShadingOptions SampledSweep::truthOptions(const AccuracyStage& stage) const {
  const ImageSize size = truthSize(stage.run(), settings_.width_px);
  ShadingOptions options = stage.options();
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  return options;
}

View SampledSweep::viewOf(const AccuracyStage& stage, int shift) const {
  const auto& [right_px, up_px] = kShifts_px[shift];
  return shiftedView(stage.view(), right_px, up_px, truthOptions(stage).height_px);
}

ReplicatedTruth SampledSweep::makeTruth(const AccuracyStage& stage, const View& view) const {
  return truthOf(stage.run(), stage.scene(), view, truthOptions(stage), settings_.spp,
                 stage.textures());
}

const SampledSweep::Truth& SampledSweep::truth(std::size_t index, const AccuracyStage& stage,
                                               int shift) {
  const auto found = truths_.find({index, shift});
  if (found != truths_.end()) return found->second;
  return keepTruth(index, stage, shift, makeTruth(stage, viewOf(stage, shift)));
}

// Batches of all views are dealt out before any truth is put together: a view has few.
void SampledSweep::prepareTruths() {
  std::map<std::pair<std::size_t, int>, SharedTruth> shared;
  RankDeal deal(allRanks().size());
  for (std::size_t i = 0; i < stages().size(); ++i)
    for (int shift = 0; shift < settings_.shifts; ++shift) {
      const View view = viewOf(stages()[i], shift);
      SharedTruth& truth =
          shared.emplace(std::pair{i, shift}, SharedTruth(allRanks(), settings_.spp)).first->second;
      truth.make(*stages()[i].sampler(truthOptions(stages()[i]), &view), deal, stopIfInterrupted);
    }
  for (auto& [key, truth] : shared)
    keepTruth(key.first, stages()[key.first], key.second, truth.join());
}

const SampledSweep::Truth& SampledSweep::keepTruth(std::size_t index, const AccuracyStage& stage,
                                                   int shift, const ReplicatedTruth& truth) {
  Truth made;
  made.coverage = truth.images.mean;
  made.row = coveredPixels(truth.images.mean);
  made.fault = radianceFault(truth.images.mean);
  for (const Image& replicate : truth.replicates)  // what one has of bad values, a mean may hide
    if (made.fault.empty() && !isSane(replicate)) made.fault = radianceFault(replicate);
  if (made.fault.empty())
    made.standard_error =
        errorOfMean(truth.images.mean, truth.replicates, [&](const Image& off, const Image& mean) {
          return principal(settings_.metric, coveredPixels(off, made.coverage),
                           coveredPixels(mean, made.coverage), stage.scene().post.exposure);
        });
  return truths_.emplace(std::pair{index, shift}, std::move(made)).first->second;
}

Image SampledSweep::image(const AccuracyStage& stage, const View& view,
                          const AccuracySetting& setting) const {
  ShadingOptions options = truthOptions(stage);
  if (setting.samples == 0) {
    if (setting.apply) setting.apply(options);
    return stage.renderer(options, &view)->readRadiance();
  }
  return sampleFrame(*stage.sampler(options, &view), setting.samples).mean;
}

AccuracyFigures SampledSweep::figuresOf(const Truth& right, const AccuracyStage& stage,
                                        const View& view, const AccuracySetting& setting) const {
  const Image frame = image(stage, view, setting);
  AccuracyFigures figures;
  figures.truth_stderr = right.standard_error;
  const std::string fault = right.fault.empty() ? radianceFault(frame) : right.fault;
  if (!fault.empty()) {
    figures.failure = stage.name() + ": " + fault;
    return figures;
  }
  const Image row = coveredPixels(frame, right.coverage);
  const double exposure = stage.scene().post.exposure;
  figures.error = principal(settings_.metric, row, right.row, exposure);
  figures.bias = relativeBias(row, right.row);
  figures.rel_mse = relMse(row, right.row);
  figures.colour_error = principal(PrincipalMetric::kColourError, row, right.row, exposure);
  return figures;
}

AccuracyFigures SampledSweep::figures(std::size_t index, const AccuracyStage& stage,
                                      const AccuracySetting& setting) {
  AccuracyFigures mean;
  mean.rel_mse = mean.colour_error = 0;
  for (int shift = 0; shift < settings_.shifts; ++shift) {
    const AccuracyFigures one =
        figuresOf(truth(index, stage, shift), stage, viewOf(stage, shift), setting);
    if (!one.failure.empty()) return one;
    mean.error += one.error / settings_.shifts;
    mean.bias += one.bias / settings_.shifts;
    mean.truth_stderr += one.truth_stderr / settings_.shifts;
    *mean.rel_mse += *one.rel_mse / settings_.shifts;
    *mean.colour_error += *one.colour_error / settings_.shifts;
  }
  return mean;
}

}  // namespace glintmark
