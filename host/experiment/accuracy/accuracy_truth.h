// Sweeps that are held against a supersampled ground truth: area lights, normal maps, the mesh's
// curvature.
#pragma once
#include "host/experiment/accuracy/accuracy_sweep.h"
#include "host/experiment/frame_truth.h"

namespace glintmark {

/// Which metric of frames is the principal one.
enum class PrincipalMetric { kRelMse, kColourError };

struct SampledTruthSettings {
  PrincipalMetric metric = PrincipalMetric::kRelMse;
  int width_px = 320;  // of the truth and of errors, at most; the height follows
  int spp = 1024;
  int shifts = 1;  // 1..std::size(kShifts_px): how many views, moved by parts of a pixel, errors
                   // are means over
};

/// "error: relMSE at 320x180 against 1024 samples a pixel", and over how many shifted views
std::string sampledTruthNote(const BenchRun& run, const SampledTruthSettings& settings);

class SampledSweep : public AccuracySweep {
 public:
  SampledSweep(BenchRun& run, const std::string& effect, const std::vector<std::string>& scenes,
               std::vector<AccuracySetting> settings, const SampledTruthSettings& truth);

  /// Every setting in every scene, "ltc/area_cloth/near/edges=acos"; none if there is one scene.
  std::vector<std::string> closerCases() const override;
  std::vector<Record> measureCloser(const std::string& case_name) override;
  std::string closerText(std::span<const Record> records) const override;
  void prepareTruths() override;

 protected:
  AccuracyFigures figures(std::size_t index, const AccuracyStage& stage,
                          const AccuracySetting& setting) override;
  /// The defaults at the truth's size.
  ShadingOptions truthOptions(const AccuracyStage& stage) const;
  /// The ground truth of a view, by its kernel unless a sweep has another. Errors are taken over
  /// the pixels that it covers.
  virtual ReplicatedTruth makeTruth(const AccuracyStage& stage, const View& view) const;
  /// The frame by a setting at the truth's size: shaded, or sampled by a replicate that the truth
  /// has not used.
  virtual Image image(const AccuracyStage& stage, const View& view,
                      const AccuracySetting& setting) const;

 private:
  // Of one view.
  struct Truth {
    Image coverage;             // the truth itself
    Image row;                  // linear, covered pixels
    double standard_error = 0;  // in the principal metric
    std::string fault;          // empty: it is right
  };
  const Truth& truth(std::size_t index, const AccuracyStage& stage, int shift);
  const Truth& keepTruth(std::size_t index, const AccuracyStage& stage, int shift,
                         const ReplicatedTruth& truth);
  AccuracyFigures figuresOf(const Truth& right, const AccuracyStage& stage, const View& view,
                            const AccuracySetting& setting) const;
  View viewOf(const AccuracyStage& stage, int shift) const;

  SampledTruthSettings settings_;
  std::map<std::pair<std::size_t, int>, Truth> truths_;  // by stage and shift
};

}  // namespace glintmark
