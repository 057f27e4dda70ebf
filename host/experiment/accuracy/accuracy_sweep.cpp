#include "host/experiment/accuracy/accuracy_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/frame_timing.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

// Geometric means over stages, repetition by repetition, as many as each has.
AccuracyTimes meanTimes(const std::vector<AccuracyTimes>& stages) {
  AccuracyTimes mean =
      *std::ranges::min_element(stages, {}, [](const AccuracyTimes& one) { return one.ms.size(); });
  const auto share = 1 / static_cast<double>(stages.size());
  const auto take = [&](std::vector<double> AccuracyTimes::*member) {
    for (std::size_t rep = 0; rep < (mean.*member).size(); ++rep) {
      double sum = 0;
      for (const AccuracyTimes& one : stages) sum += std::log((one.*member)[rep]);
      (mean.*member)[rep] = std::exp(share * sum);
    }
  };
  take(&AccuracyTimes::ratio);
  take(&AccuracyTimes::ms);
  return mean;
}

}  // namespace

AccuracyTimes timesInTurn(FrameRenderer& standard, FrameRenderer& setting, int reps) {
  const int rounds = lastingReps(standard, setting, reps);
  TurnTimes times = shadeInTurn(standard, setting, rounds);
  std::swap(times.first_ms, times.second_ms);
  return {times.ratios(), times.first_ms, {}};
}

std::vector<std::string> knobsOf(const std::vector<AccuracySetting>& settings) {
  std::vector<std::string> knobs;
  for (const AccuracySetting& setting : settings)
    if (const std::string knob = knobOf(setting.name); knobs.empty() || knobs.back() != knob)
      knobs.push_back(knob);
  return knobs;
}

AccuracyStage::AccuracyStage(BenchRun& run, const std::string& name)
    : run_(run),
      name_(name),
      scene_(openScene(run.session().common, CaseName::parse(name).word(0))),
      view_(scene_.view(CaseName::parse(name).word(1))),
      textures_(std::make_shared<NormalTextures>(run.device())) {}

ShadingOptions AccuracyStage::options() const {
  return run_.shading();
}

std::unique_ptr<TruthRenderer> AccuracyStage::sampler(const ShadingOptions& options,
                                                      const View* view) const {
  return std::make_unique<TruthRenderer>(run_.device(), scene_, view == nullptr ? view_ : *view,
                                         options, run_.threads(), textures_);
}

std::unique_ptr<FrameRenderer> AccuracyStage::renderer(const ShadingOptions& options,
                                                       const View* view, const Scene* scene) const {
  return preparedFrame(run_, scene == nullptr ? scene_ : *scene, view == nullptr ? view_ : *view,
                       options, textures_);
}

AccuracySweep::AccuracySweep(BenchRun& run, std::string effect,
                             const std::vector<std::string>& scenes,
                             std::vector<AccuracySetting> settings, AccuracyNotes notes)
    : run_(run),
      effect_(std::move(effect)),
      scenes_(scenes),
      settings_(std::move(settings)),
      notes_(std::move(notes)) {}

std::vector<std::string> AccuracySweep::cases() const {
  std::vector<std::string> cases;
  for (const AccuracySetting& setting : settings_)
    cases.push_back(accuracyCase(effect_, setting.name));
  return cases;
}

std::vector<AccuracyStage>& AccuracySweep::stages() {
  if (stages_.empty())
    for (const std::string& scene : scenes_) stages_.emplace_back(run_, scene);
  return stages_;
}

FrameRenderer& AccuracySweep::standard(std::size_t index) {
  std::unique_ptr<FrameRenderer>& renderer = standards_[index];
  if (!renderer) renderer = stages()[index].renderer(stages()[index].options());
  return *renderer;
}

AccuracyTimes AccuracySweep::measureTimes(std::size_t index, const AccuracySetting& setting) {
  FrameRenderer& usual = standard(index);
  if (setting.role == kAccuracyDefault) {
    AccuracyTimes times = timesInTurn(usual, usual, run_.options().reps);
    times.ratio.assign(times.ms.size(), 1);
    return times;
  }
  ShadingOptions options = stages_[index].options();
  setting.apply(options);
  return timesInTurn(usual, *stages_[index].renderer(options), run_.options().reps);
}

AccuracyTimes AccuracySweep::measureSampledTimes(std::size_t index,
                                                 const AccuracySetting& setting) {
  AccuracyTimes times;
  const auto samples = static_cast<std::uint32_t>(setting.samples);
  const auto sampled = stages_[index].sampler(stages_[index].options());
  sampled->prepare();
  sampled->addSamples(0, 1);  // compiles
  double spent_ms = 0;
  for (int rep = 0; rep < run_.options().reps && (rep == 0 || spent_ms < kLeastTime_ms); ++rep) {
    const double standard_ms = shadeMs(standard(index));
    times.ms.push_back(sampled->addSamples(0, samples).shading_event_ns * kMsPerNs);
    times.ratio.push_back(times.ms.back() / standard_ms);
    spent_ms += times.ms.back();
  }
  return times;
}

const std::vector<StageMeasured>& AccuracySweep::measuredStages(const AccuracySetting& setting) {
  const std::string key = setting.role == kAccuracyDefault ? "" : setting.name;
  if (const auto found = measured_.find(key); found != measured_.end()) return found->second;
  std::vector<StageMeasured> all;
  for (std::size_t i = 0; i < stages().size(); ++i) {
    stopIfInterrupted();
    all.push_back({figures(i, stages_[i], setting), setting.samples > 0
                                                        ? measureSampledTimes(i, setting)
                                                        : measureTimes(i, setting)});
  }
  all.front().times.fit_ratio = fitRatios(stages_.front(), setting);
  return measured_.emplace(key, std::move(all)).first->second;
}

std::vector<Record> AccuracySweep::measure(const std::string& case_name) {
  const auto setting = std::ranges::find_if(settings_, [&](const AccuracySetting& one) {
    return accuracyCase(effect_, one.name) == case_name;
  });
  if (setting == settings_.end()) throw Error(fmt::format("no case {}", case_name));
  std::vector<AccuracyFigures> figures_of_stages;
  std::vector<AccuracyTimes> times_of_stages;
  for (const StageMeasured& stage : measuredStages(*setting)) {
    figures_of_stages.push_back(stage.figures);
    times_of_stages.push_back(stage.times);
  }
  AccuracyTimes times = meanTimes(times_of_stages);
  times.fit_ratio = times_of_stages.front().fit_ratio;
  AccuracyNotes notes = notes_;
  if (setting->role == kAccuracyDefault)
    notes.time = "the default itself, measured once for all knobs";
  return accuracyRecords(run_, case_name, setting->role, meanFigures(figures_of_stages), times,
                         notes);
}

}  // namespace glintmark
