// What `accuracy` measures of one effect: the settings of its knobs, each against the truth and
// against the default.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"

namespace glintmark {

/// How wrong one setting is in one scene. `error` is the effect's principal metric, truth_stderr
/// what the truth itself may be off, in the same metric; results/README.md has the others.
struct AccuracyFigures {
  double error = 0, truth_stderr = 0, bias = 0;
  std::optional<double> rel_mse, colour_error;         // of pictures
  std::optional<double> variance_ratio, motion_ratio;  // of glints
  std::string failure;  // why the figures are not valid, empty if they are
};

/// Geometric means over scenes, so that a scene with large errors does not drown the others; of the
/// bias, which has a sign, the arithmetic mean. `figures` not empty; the first failure stays.
AccuracyFigures meanFigures(std::span<const AccuracyFigures> figures);

/// Times of one setting: samples of its time over the default's, measured in turn, and its own
/// [ms]. `fit_ratio` is the same of what is precomputed, empty where that is none of the effect's.
struct AccuracyTimes {
  std::vector<double> ratio, ms, fit_ratio;
};

/// Notes of a case's records: which metric the error is and where it comes from, how times were
/// taken.
struct AccuracyNotes {
  std::string error, time;
};

/// The records of one case of `role` (kAccuracyDefault, ...), all metrics but `pareto`.
std::vector<Record> accuracyRecords(const BenchRun& run, const std::string& case_name,
                                    const std::string& role, const AccuracyFigures& figures,
                                    const AccuracyTimes& times, const AccuracyNotes& notes);

class AccuracyEffect {
 public:
  virtual ~AccuracyEffect() = default;
  /// "glints/ka=16", ...
  virtual std::vector<std::string> cases() const = 0;
  virtual std::vector<Record> measure(const std::string& case_name) = 0;
  /// Of all ranks, which share the work: makes the truths that cases are held against, and those of
  /// closer cases. Without it each is made when it is first needed.
  virtual void prepareTruths() {}
  virtual void prepareCloserTruths() {}
  /// Cases that say more of settings or of the truth, without times; measured after the others.
  virtual std::vector<std::string> closerCases() const { return {}; }
  virtual std::vector<Record> measureCloser(const std::string& case_name);
  /// Below the table; empty if there is nothing to add.
  virtual std::string closerText(std::span<const Record> records) const;
  /// What was asked for and left out, and why; empty if nothing.
  virtual std::string leftOut() const { return ""; }
};

/// The knob of a setting or case: "ka" of "ka=16" and of "glints/ka=16".
std::string knobOf(const std::string& setting);
/// "glints/ka=16" of effect "glints" and setting "ka=16".
std::string accuracyCase(const std::string& effect, const std::string& setting);

struct AccuracyKind {
  std::string name;
  std::vector<std::string> knobs;           // rivals too
  std::vector<std::string> scenes;          // "scene/view"
  std::vector<std::string> default_scenes;  // of a run that names none
  std::unique_ptr<AccuracyEffect> (*make)(BenchRun& run, const std::vector<std::string>& scenes);
};

AccuracyKind glintsAccuracy();
AccuracyKind ltcAccuracy();
AccuracyKind gmmAccuracy();
AccuracyKind curvatureAccuracy();
AccuracyKind msbrdfAccuracy();

}  // namespace glintmark
