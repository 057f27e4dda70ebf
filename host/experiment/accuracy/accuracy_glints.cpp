// Knobs of procedural glints, held against placed microdetails. [ZK16]
//
// A pixel's glints are drawn by chance, so no picture is the truth: it is the distribution of pixel
// values, and how they change. Errors are those of lattices of pixels (glint_axis.h), times and
// checks those of the scenes' frames.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/core/progress.h"
#include "host/experiment/accuracy/accuracy_sweep.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/accuracy/glint_judge.h"
#include "host/experiment/accuracy/glint_stage_table.h"
#include "host/experiment/accuracy/knob_settings.h"
#include "host/experiment/zk16/zk16_case.h"
#include "host/experiment/zk16/zk16_table.h"
#include "host/ocl/switches.h"
#include "host/parallel/ranks.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr const char* kMethodKnob = "method";
constexpr const char* kTruthKnob = "truth";

// Pixels a side of the lattices: 64 for frames of 1080 rows, fewer for smaller ones.
int latticeSide(const BenchRun& run) {
  return std::clamp(run.size().height_px / 16, 8, 64);
}

double meanLuminance(const Image& image) {
  const Image row = coveredPixels(image);
  double sum = 0;
  for (std::size_t i = 0; i < row.pixels.size(); i += 3)
    sum += luminance(row.pixels[i], row.pixels[i + 1], row.pixels[i + 2]);
  return row.pixels.empty() ? 0 : 3 * sum / static_cast<double>(row.pixels.size());
}

// A program that shades glints by a setting.
KernelConfig configOf(const ShadingOptions& options) {
  KernelConfig config;
  config.width = options.lanes;
  config.glint = true;
  config.size_variation = false;
  setKnobs(options, &KernelConfig::glint, config);
  setKnobs(options, kEveryProgram, config);
  return config;
}

class GlintSweep : public AccuracySweep {
 public:
  GlintSweep(BenchRun& run, const std::vector<std::string>& scenes,
             std::vector<AccuracySetting> settings, const AccuracyNotes& notes);

  std::vector<std::string> closerCases() const override;
  std::vector<Record> measureCloser(const std::string& case_name) override;
  std::string closerText(std::span<const Record> records) const override;
  void prepareTruths() override { judge_.shareTruths(allRanks(), PixelFilter::kBox); }
  void prepareCloserTruths() override {
    for (const PixelFilter filter : {PixelFilter::kBox, PixelFilter::kTent})
      judge_.shareTruths(allRanks(), filter);
  }

 protected:
  AccuracyFigures figures(std::size_t index, const AccuracyStage& stage,
                          const AccuracySetting& setting) override;

 private:
  std::string failureOf(std::size_t index, const AccuracyStage& stage,
                        const AccuracySetting& setting, const ShadingOptions& options);
  ShadingOptions optionsOf(const AccuracySetting& setting) const;
  // Of all stages by one setting, measured once.
  const std::vector<GlintFigures>& judged(const AccuracySetting& setting);

  BenchRun& run_;
  std::vector<AccuracySetting> settings_;
  Progress progress_;
  GlintJudge judge_;
  std::map<std::size_t, double> smooth_means_;  // by scene
  std::map<std::string, std::vector<GlintFigures>> judged_;
};

GlintSweep::GlintSweep(BenchRun& run, const std::vector<std::string>& scenes,
                       std::vector<AccuracySetting> settings, const AccuracyNotes& notes)
    : AccuracySweep(run, "glints", scenes, settings, notes),
      run_(run),
      settings_(std::move(settings)),
      progress_(run.session().common.quiet),
      judge_(run.device(), run.cache(), run.info().width, latticeSide(run),
             [this](const std::string& what) {
               stopIfInterrupted();
               if (!what.empty()) progress_.show(0, 0, "glints: " + what);
             }) {}

ShadingOptions GlintSweep::optionsOf(const AccuracySetting& setting) const {
  ShadingOptions options = run_.shading();
  if (setting.apply) setting.apply(options);
  return options;
}

const std::vector<GlintFigures>& GlintSweep::judged(const AccuracySetting& setting) {
  const auto found = judged_.find(setting.name);
  if (found != judged_.end()) return found->second;
  const KernelConfig config = configOf(optionsOf(setting));
  std::vector<GlintFigures> stages;
  for (std::size_t i = 0; i < glintStages().size(); ++i) {
    progress_.show(static_cast<int>(i), static_cast<int>(glintStages().size()),
                   "glints: pixels by " + setting.name);
    stages.push_back(judge_.method(config, i, knobOf(setting.name) == kMethodKnob));
  }
  progress_.clear();
  return judged_.emplace(setting.name, std::move(stages)).first->second;
}

// Why the frame of a scene is not to be trusted; empty if it is.
std::string GlintSweep::failureOf(std::size_t index, const AccuracyStage& stage,
                                  const AccuracySetting& setting, const ShadingOptions& options) {
  const Image frame = stage.renderer(options)->readRadiance();
  if (const std::string fault = radianceFault(frame); !fault.empty())
    return stage.name() + ": " + fault;
  if (!smooth_means_.contains(index)) {
    ShadingOptions smooth = stage.options();
    smooth.glints = false;
    smooth_means_[index] = meanLuminance(stage.renderer(smooth)->readRadiance());
  }
  // Crude settings may be far off, that is what is measured; the default may not.
  const double off = meanLuminance(frame) / smooth_means_[index] - 1;
  if (setting.role != kAccuracyDefault || std::abs(off) <= kZk16MeanBound) return "";
  return fmt::format("{}: mean radiance is {:+.1f}% off the smooth lobes'", stage.name(),
                     100 * off);
}

AccuracyFigures GlintSweep::figures(std::size_t index, const AccuracyStage& stage,
                                    const AccuracySetting& setting) {
  AccuracyFigures figures;
  figures.failure = failureOf(index, stage, setting, optionsOf(setting));
  std::vector<double> errors, noises, variances, motions;
  const std::vector<GlintStage> stages = glintStages();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const GlintFigures& one = judged(setting)[i];
    if (!one.sane) {
      figures.failure = "a ratio of glints is negative or not finite";
      return figures;
    }
    if (stages[i].isNear()) continue;
    errors.push_back(one.error);
    noises.push_back(one.noise);
    variances.push_back(one.variance_ratio.mean());
    motions.push_back(one.motion_ratio.mean());
    figures.bias += one.mean.mean() - 1;
  }
  figures.bias /= static_cast<double>(errors.size());
  figures.error = geometricMeanOf(errors);
  figures.truth_stderr = geometricMeanOf(noises);
  figures.variance_ratio = geometricMeanOf(variances);
  figures.motion_ratio = geometricMeanOf(motions);
  return figures;
}

std::vector<std::string> GlintSweep::closerCases() const {
  std::vector<std::string> cases;
  const auto add = [&](const std::string& setting) {
    for (const GlintStage& stage : glintStages())
      cases.push_back(glintStageCase(accuracyCase("glints", setting), stage));
  };
  for (const AccuracySetting& setting : settings_)
    if (knobOf(setting.name) == kMethodKnob) add(setting.name);
  for (const char* form : kTruthForms) add(fmt::format("{}={}", kTruthKnob, form));
  return cases;
}

std::vector<Record> GlintSweep::measureCloser(const std::string& case_name) {
  const std::size_t stage = glintStageOf(case_name);
  const CaseName name = CaseName::parse(case_name);
  if (const auto form = name.value(kTruthKnob))
    return glintStageRecords(run_, case_name, kAccuracyRival, judge_.truthForm(*form, stage));
  const std::string setting = fmt::format("{}={}", kMethodKnob, name.value(kMethodKnob).value());
  const auto found = std::ranges::find(settings_, setting, &AccuracySetting::name);
  if (found == settings_.end()) throw Error(fmt::format("no case {}", case_name));
  return glintStageRecords(run_, case_name, found->role, judged(*found)[stage]);
}

std::string GlintSweep::closerText(std::span<const Record> records) const {
  return glintStageText(records);
}

std::vector<AccuracySetting> glintSettings(int device_lanes) {
  KnobSettings knobs("glints");
  std::vector<AccuracySetting> all;
  knobs.moveTo(all, {"method", "ka", "grids"});
  const auto binomial = [&](const std::string& name, int form, int terms) {
    // Capped inversion of 16 terms is what method zk16 draws by.
    const bool is_default = form == static_cast<int>(BinomialForm::kCapped) &&
                            terms == switchNamed("BINOMIAL_TERMS").standard;
    all.push_back({"binomial=" + name,
                   [form, terms](ShadingOptions& o) {
                     turnKnob(o, "BINOMIAL", form);
                     turnKnob(o, "BINOMIAL_TERMS", terms);
                   },
                   is_default ? kAccuracyDefault : kAccuracyKnob});
  };
  const Switch &forms = switchNamed("BINOMIAL"), &terms = switchNamed("BINOMIAL_TERMS");
  for (const int form : forms.sweep.values) {
    if (form != static_cast<int>(BinomialForm::kCapped))
      binomial(forms.nameOf(form), form, terms.standard);
    else
      for (const int count : terms.sweep.values)
        binomial(fmt::format("{}_{}", forms.nameOf(form), count), form, count);
  }
  knobs.moveRestTo(all);
  for (const int lanes : switchNamed("WIDTH").sweep.values)
    all.push_back({fmt::format("lanes={}", lanes), [lanes](ShadingOptions& o) { o.lanes = lanes; },
                   lanes == device_lanes ? kAccuracyDefault : kAccuracyKnob});
  return all;
}

std::vector<std::string> glintScenes() {
  std::vector<std::string> scenes;
  for (const Zk16PaperRow& row : kZk16Table1)
    for (const std::string_view view : kZk16Views)
      scenes.push_back(CaseName{{std::string(row.scene), std::string(view)}}.text());
  return scenes;
}

}  // namespace

AccuracyKind glintsAccuracy() {
  std::vector<std::string> knobs = knobsOf(glintSettings(1));
  knobs.emplace_back(kTruthKnob);
  return {
      "glints",
      knobs,
      glintScenes(),
      {"screen_plane/grazing", "snow/grazing"},
      [](BenchRun& run, const std::vector<std::string>& scenes) {
        const int side = latticeSide(run);
        const AccuracyNotes notes = {
            fmt::format("error: Wasserstein distance between pixels and those of placed "
                        "microdetails, over their mean; {} lattices of {}x{} pixels at each of "
                        "{} steps of a zoom by two, geometric mean over {} kinds of pixels",
                        kGlintReplicates, side, side, kGlintZoomSteps, glintStages().size() - 1),
            fmt::format("kernel events at {}, in turn with the default, geometric mean over {}",
                        run.options().size, fmt::join(scenes, ", "))};
        return std::unique_ptr<AccuracyEffect>(
            std::make_unique<GlintSweep>(run, scenes, glintSettings(run.info().width), notes));
      }};
}

}  // namespace glintmark
