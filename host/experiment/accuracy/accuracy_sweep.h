// Sweep of the knobs of an effect that frames show: glints, area lights, normal maps.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/experiment/accuracy/accuracy_effect.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/ground_truth.h"

namespace glintmark {

/// Times of `setting` over those of `standard`, frames shaded in turn, both prepared: at least
/// `reps` of each, more where frames are short.
AccuracyTimes timesInTurn(FrameRenderer& standard, FrameRenderer& setting, int reps);

/// One value of a knob.
struct AccuracySetting {
  std::string name;                                 // "ka=16"
  std::function<void(ShadingOptions&)> apply = {};  // empty: nothing
  std::string role = "knob";                        // kAccuracyDefault, ...
  int samples = 0;  // > 0: so many samples a pixel of the ground truth's kernel instead
};

/// Their knobs, each once, in order.
std::vector<std::string> knobsOf(const std::vector<AccuracySetting>& settings);

/// A scene in one of its views, with what renderers of it share.
class AccuracyStage {
 public:
  /// `name` is "scene/view".
  AccuracyStage(BenchRun& run, const std::string& name);

  BenchRun& run() const { return run_; }
  const std::string& name() const { return name_; }
  const Scene& scene() const { return scene_; }
  const View& view() const { return view_; }
  /// The defaults at the command line's size.
  ShadingOptions options() const;
  /// Prepared and shaded once. `scene` and `view`, if given, in place of the stage's own; the scene
  /// must live as long as the renderer.
  std::unique_ptr<FrameRenderer> renderer(const ShadingOptions& options, const View* view = nullptr,
                                          const Scene* scene = nullptr) const;
  /// Of the ground truth at the size of `options`, before prepare(); `view` as above.
  std::unique_ptr<TruthRenderer> sampler(const ShadingOptions& options,
                                         const View* view = nullptr) const;
  const std::shared_ptr<NormalTextures>& textures() const { return textures_; }

 private:
  BenchRun& run_;
  std::string name_;
  Scene scene_;
  View view_;
  std::shared_ptr<NormalTextures> textures_;
};

/// Measures settings one after another: errors by the effect, times in turn with the default.
/// A setting in one scene.
struct StageMeasured {
  AccuracyFigures figures;
  AccuracyTimes times;
};

class AccuracySweep : public AccuracyEffect {
 public:
  /// `settings` hold at least one default.
  AccuracySweep(BenchRun& run, std::string effect, const std::vector<std::string>& scenes,
                std::vector<AccuracySetting> settings, AccuracyNotes notes);

  std::vector<std::string> cases() const override;
  std::vector<Record> measure(const std::string& case_name) override;

 protected:
  const std::vector<std::string>& scenes() const { return scenes_; }
  const std::vector<AccuracySetting>& settings() const { return settings_; }
  const std::string& effect() const { return effect_; }
  BenchRun& run() const { return run_; }
  /// Of every scene, in their order; measured once, the default once for all knobs.
  const std::vector<StageMeasured>& measuredStages(const AccuracySetting& setting);
  std::vector<AccuracyStage>& stages();
  /// Errors of a setting in stage `index`; called once per setting and stage.
  virtual AccuracyFigures figures(std::size_t index, const AccuracyStage& stage,
                                  const AccuracySetting& setting) = 0;
  /// Times of a setting's precomputation over the default's, in turn; empty if it has none.
  virtual std::vector<double> fitRatios(const AccuracyStage& stage,
                                        const AccuracySetting& setting) const {
    (void)stage, (void)setting;
    return {};
  }

 private:
  FrameRenderer& standard(std::size_t index);
  AccuracyTimes measureTimes(std::size_t index, const AccuracySetting& setting);
  AccuracyTimes measureSampledTimes(std::size_t index, const AccuracySetting& setting);

  BenchRun& run_;
  std::string effect_;
  std::vector<std::string> scenes_;
  std::vector<AccuracySetting> settings_;
  AccuracyNotes notes_;
  std::vector<AccuracyStage> stages_;                                // loaded when first needed
  std::map<std::size_t, std::unique_ptr<FrameRenderer>> standards_;  // the default, by stage
  std::map<std::string, std::vector<StageMeasured>> measured_;       // by setting, "" the default
};

}  // namespace glintmark
