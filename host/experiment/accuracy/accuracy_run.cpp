#include "host/experiment/accuracy/accuracy_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/core/unknown_name.h"
#include "host/experiment/accuracy/accuracy_chart.h"
#include "host/experiment/accuracy/accuracy_effect.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/all_tables.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/survival.h"
#include "host/parallel/ranks.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr std::uint64_t kLeastRays = 100'000, kMostRays = 1'000'000'000'000;

// In the order in which they are measured and printed.
std::vector<AccuracyKind> allKinds() {
  return {glintsAccuracy(), ltcAccuracy(), gmmAccuracy(), curvatureAccuracy(), msbrdfAccuracy()};
}

std::vector<AccuracyKind> chooseKinds(const std::vector<std::string>& names) {
  const std::vector<std::string> known = accuracyEffects();
  for (const std::string& name : names) requireKnownName("effect", name, known);
  std::vector<AccuracyKind> kinds = allKinds();
  if (!names.empty())
    std::erase_if(kinds, [&](const AccuracyKind& kind) {
      return std::ranges::find(names, kind.name) == names.end();
    });
  return kinds;
}

// Does "snow/steep" go by the name "snow" or "snow/steep"?
bool goesBy(const std::string& scene, const std::string& name) {
  return scene == name || CaseName::parse(scene).word(0) == name;
}

// The scenes of an effect that were asked for; its own if none were.
std::vector<std::string> chosenScenes(const AccuracyKind& kind,
                                      const std::vector<std::string>& names) {
  if (names.empty()) return kind.default_scenes;
  std::vector<std::string> scenes;
  std::ranges::copy_if(kind.scenes, std::back_inserter(scenes), [&](const std::string& scene) {
    return std::ranges::any_of(names, [&](const auto& name) { return goesBy(scene, name); });
  });
  return scenes;
}

void requireKnownScenes(const std::vector<AccuracyKind>& kinds,
                        const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const AccuracyKind& kind : kinds)
    known.insert(known.end(), kind.scenes.begin(), kind.scenes.end());
  for (const std::string& name : names)
    if (std::ranges::none_of(known, [&](const auto& scene) { return goesBy(scene, name); }))
      throw Error(unknownName("scene", name, known));
}

void requireKnownKnobs(const std::vector<AccuracyKind>& kinds,
                       const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const AccuracyKind& kind : kinds)
    for (const std::string& knob : kind.knobs)
      if (std::ranges::find(known, knob) == known.end()) known.push_back(knob);
  for (const std::string& name : names) requireKnownName("knob", name, known);
}

// Those whose knob was asked for; all if none was.
std::vector<std::string> chosenCases(std::vector<std::string> cases,
                                     const std::vector<std::string>& knobs) {
  if (!knobs.empty())
    std::erase_if(cases, [&](const std::string& name) {
      return std::ranges::find(knobs, knobOf(name)) == knobs.end();
    });
  return cases;
}

std::string headText(const BenchRun& run) {
  return fmt::format(
      "What accuracy costs, at {}, {} lanes, {:.0f} GFLOP/s\non {:.90}\n"
      "*: the default; s.e.: the truth's own standard error; optimal: no other setting is both "
      "faster\n"
      "and closer, where times and errors within {:.0f} % and errors below s.e. count as equal; "
      "variance\n"
      "and motion: over the truth's; fit ratio: time before the first frame. Beside the default: "
      "error in\n"
      "its time, time over its time for its error, 1 / (mean square error x time) over its; what "
      "is "
      "not\n"
      "sampled has one time and one error, and else never reaches them.\n\n",
      run.options().size, run.info().width, run.info().peak_gflops, run.info().device,
      100 * kAccuracyStep);
}

int measureAccuracy(const Session& session, const AccuracySelection& selection,
                    const std::vector<AccuracyKind>& kinds, const BenchOptions& options) {
  const InterruptGuard guard;
  BenchRun run(session, options);
  std::string left_out, closer;
  for (const AccuracyKind& kind : kinds) {
    const auto effect = kind.make(run, chosenScenes(kind, options.scenes));
    run.measureCases(
        accuracySpec().name, chosenCases(effect->cases(), selection.knobs),
        {"error", "truth_stderr", "time_ratio"},
        [&](const std::string& name) { return effect->measure(name); },
        [&] { effect->prepareTruths(); });
    run.measureCases(
        accuracySpec().name, chosenCases(effect->closerCases(), selection.knobs),
        {"error", "truth_stderr"},
        [&](const std::string& name) { return effect->measureCloser(name); },
        [&] { effect->prepareCloserTruths(); });
    if (!allRanks().isFirst()) continue;
    closer += effect->closerText(run.recordsOf(accuracySpec().name));
    if (const std::string left = effect->leftOut(); !left.empty()) left_out += "\n" + left + "\n";
  }
  if (!allRanks().isFirst()) return kExitDone;
  requireMeasured(run.records().size());
  run.addDerived(accuracyDerived(run.recordsOf(accuracySpec().name)));
  const std::vector<Record> records = run.recordsOf(accuracySpec().name);
  writeAccuracyCharts(records, run.folder());
  return run.finish(headText(run) + accuracyTableText(records) + closer + left_out +
                    invalidText(records));
}

}  // namespace

std::vector<std::string> accuracyEffects() {
  std::vector<std::string> names;
  for (const AccuracyKind& kind : allKinds()) names.push_back(kind.name);
  return names;
}

int runAccuracy(const Session& session, const AccuracySelection& selection, BenchOptions options) {
  std::vector<AccuracyKind> kinds = chooseKinds(selection.effects);
  requireKnownScenes(kinds, options.scenes);
  requireKnownKnobs(kinds, selection.knobs);
  if (options.rays < kLeastRays || options.rays > kMostRays)
    throw Error(fmt::format("--rays {} is not from {} to {}", options.rays, kLeastRays, kMostRays));
  std::erase_if(kinds, [&](const AccuracyKind& kind) {
    const bool turned = selection.knobs.empty() ||
                        std::ranges::find_first_of(kind.knobs, selection.knobs) != kind.knobs.end();
    return !turned || chosenScenes(kind, options.scenes).empty();
  });
  options.more_key = {
      {"rays", std::to_string(options.rays)},
      {"scenes",
       options.scenes.empty() ? "default" : fmt::format("{}", fmt::join(options.scenes, " "))}};
  return runSurviving(session.common.quiet, [&](bool first) {
    options.resume = options.resume || !first;
    return measureAccuracy(session, selection, kinds, options);
  });
}

// `bench` does not measure it.
BenchTable accuracyTable() {
  return {.spec = accuracySpec()};
}

}  // namespace glintmark
