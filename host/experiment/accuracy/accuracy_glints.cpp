// Knobs of procedural glints, held against their method `exact`. [ZK16]
//
// A pixel's glints are drawn by chance, so no picture is the truth: it is the distribution of pixel
// values. Frames whose textures are moved far away are drawn anew, and several of them by method
// `exact` are the truth.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host/experiment/accuracy/accuracy_sweep.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/accuracy/knob_settings.h"
#include "host/experiment/zk16/zk16_case.h"
#include "host/experiment/zk16/zk16_table.h"
#include "host/ocl/switches.h"
#include "host/report/distribution.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr int kTruthFrames = 4;
constexpr int kMotionFrames = 3;
constexpr double kMotionStep_px = 0.25;
// How far uvs move from one truth frame to the next: whole numbers off the cells' grids.
const glm::dvec2 kUvStep = {37.129, 53.817};

ShadingOptions exactOptions(const AccuracyStage& stage) {
  ShadingOptions options = stage.options();
  options.method = GlintMethod::kExact;
  return options;
}

// Luminances of the covered pixels, ascending.
std::vector<float> sortedLuminances(const Image& image) {
  const Image row = coveredPixels(image);
  std::vector<float> values;
  for (std::size_t i = 0; i < row.pixels.size(); i += 3)
    values.push_back(luminance(row.pixels[i], row.pixels[i + 1], row.pixels[i + 2]));
  std::ranges::sort(values);
  return values;
}

// The view moved sideways by `shift_px` pixels at its target's distance.
View shiftedView(const View& view, double shift_px, int height_px) {
  const glm::dvec3 axis = view.target - view.eye;
  const double distance = glm::length(axis);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, view.up));
  const double pixel = 2 * distance * std::tan(glm::radians(view.fov_y_deg) / 2) / height_px;
  View moved = view;
  moved.eye += shift_px * pixel * right;
  moved.target += shift_px * pixel * right;
  moved.orbit.reset();
  return moved;
}

class GlintSweep : public AccuracySweep {
 public:
  using AccuracySweep::AccuracySweep;

 protected:
  AccuracyFigures figures(std::size_t index, const AccuracyStage& stage,
                          const AccuracySetting& setting) override;

 private:
  struct Truth {
    Image frame;                          // method exact, of the stage's own texture
    std::vector<float> values;            // of all truth frames, ascending
    double mean = 0, standard_error = 0;  // distance of one more frame from the others
    double smooth_mean = 0;
    std::vector<Image> motion;
    bool sane = false;
  };
  const Truth& truth(std::size_t index, const AccuracyStage& stage);
  std::vector<Image> motionFrames(const AccuracyStage& stage, const ShadingOptions& options) const;

  std::map<std::size_t, Truth> truths_;
};

std::vector<Image> GlintSweep::motionFrames(const AccuracyStage& stage,
                                            const ShadingOptions& options) const {
  std::vector<Image> frames;
  for (int i = 1; i <= kMotionFrames; ++i) {
    const View view = shiftedView(stage.view(), i * kMotionStep_px, options.height_px);
    frames.push_back(toneMap(stage.renderer(options, &view)->readRadiance(),
                             {.exposure = stage.scene().post.exposure}));
  }
  return frames;
}

double meanOf(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

const GlintSweep::Truth& GlintSweep::truth(std::size_t index, const AccuracyStage& stage) {
  const auto found = truths_.find(index);
  if (found != truths_.end()) return found->second;
  const ShadingOptions exact = exactOptions(stage);
  Truth made;
  made.frame = stage.renderer(exact)->readRadiance();
  made.sane = isSane(made.frame);
  Scene moved = stage.scene();
  std::vector<std::vector<float>> frames;
  for (int i = 0; i < kTruthFrames; ++i) {
    for (glm::dvec2& uv : moved.mesh.uvs) uv += kUvStep;
    const Image image = stage.renderer(exact, nullptr, &moved)->readRadiance();
    made.sane = made.sane && isSane(image);
    frames.push_back(sortedLuminances(image));
  }
  made.sane = made.sane && !frames.front().empty();
  if (made.sane) {
    for (const std::vector<float>& frame : frames)
      made.values.insert(made.values.end(), frame.begin(), frame.end());
    std::ranges::sort(made.values);
    made.mean = meanOf(made.values);
    made.standard_error =
        wassersteinDistance(sortedLuminances(made.frame), made.values) / made.mean;
    ShadingOptions smooth = stage.options();
    smooth.glints = false;
    made.smooth_mean = meanOf(sortedLuminances(stage.renderer(smooth)->readRadiance()));
    made.motion = motionFrames(stage, exact);
  }
  return truths_.emplace(index, std::move(made)).first->second;
}

AccuracyFigures GlintSweep::figures(std::size_t index, const AccuracyStage& stage,
                                    const AccuracySetting& setting) {
  const Truth& right = truth(index, stage);
  ShadingOptions options = stage.options();
  if (setting.apply) setting.apply(options);
  const Image frame = stage.renderer(options)->readRadiance();
  AccuracyFigures figures;
  figures.truth_stderr = right.standard_error;
  if (!right.sane || !isSane(frame)) {
    figures.failure = stage.name() + ": radiance is negative, not finite or missing";
    return figures;
  }
  const std::vector<float> values = sortedLuminances(frame);
  const double mean = meanOf(values);
  // Crude settings may be far off, that is what is measured; the truth and the default may not.
  const double checked = setting.role == kAccuracyDefault ? mean : right.mean;
  if (!(std::abs(checked / right.smooth_mean - 1) <= kZk16MeanBound))
    figures.failure = fmt::format("{}: mean radiance is {:+.1f}% off the smooth lobes'",
                                  stage.name(), 100 * (checked / right.smooth_mean - 1));
  const double exposure = stage.scene().post.exposure;
  const Image row = coveredPixels(frame), truth_row = coveredPixels(right.frame);
  figures.bias = mean / right.mean - 1;
  figures.rel_mse = relMse(row, truth_row);
  figures.colour_error =
      colourError(toneMap(row, {.exposure = exposure}), toneMap(truth_row, {.exposure = exposure}));
  figures.distribution_distance = wassersteinDistance(values, right.values) / right.mean;
  figures.error = *figures.distribution_distance;
  const std::vector<Image> motion = motionFrames(stage, options);
  double change = 0;
  for (std::size_t i = 1; i < motion.size(); ++i)
    change += changeError(motion[i - 1], motion[i], right.motion[i - 1], right.motion[i]);
  figures.frame_to_frame_error = change / static_cast<double>(motion.size() - 1);
  return figures;
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
  return {"glints",
          knobsOf(glintSettings(1)),
          glintScenes(),
          {"screen_plane/grazing", "snow/grazing"},
          [](BenchRun& run, const std::vector<std::string>& scenes) {
            const AccuracyNotes notes = {
                fmt::format("error: Wasserstein distance between pixel luminances and {} frames of "
                            "method exact, over their mean, at {}, geometric mean over {}",
                            kTruthFrames, run.options().size, fmt::join(scenes, ", ")),
                "kernel events, in turn with the default"};
            return std::unique_ptr<AccuracyEffect>(std::make_unique<GlintSweep>(
                run, "glints", scenes, glintSettings(run.info().width), notes));
          }};
}

}  // namespace glintmark
