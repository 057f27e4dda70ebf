// glintmark accuracy: what each knob's accuracy costs in time.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/output_options.h"
#include "host/core/error.h"
#include "host/experiment/accuracy/accuracy_effect.h"
#include "host/experiment/interrupt.h"
#include "host/report/accuracy_table.h"

namespace glintmark {
namespace {

constexpr std::uint64_t kLeastRays = 100'000, kMostRays = 1'000'000'000'000;

// What was asked for; empty lists stand for all.
struct Selection {
  std::vector<std::string> effects, knobs;
};

// In the order in which they are measured and printed.
std::vector<AccuracyKind> allKinds() {
  return {glintsAccuracy(), ltcAccuracy(), gmmAccuracy(), msbrdfAccuracy()};
}

std::vector<std::string> effectNames() {
  std::vector<std::string> names;
  for (const AccuracyKind& kind : allKinds()) names.push_back(kind.name);
  return names;
}

std::vector<AccuracyKind> chooseKinds(const std::vector<std::string>& names) {
  const std::vector<std::string> known = effectNames();
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      throw Error(fmt::format("unknown effect '{}'; effects are {}", name, fmt::join(known, ", ")));
  std::vector<AccuracyKind> kinds = allKinds();
  if (!names.empty())
    std::erase_if(kinds, [&](const AccuracyKind& kind) {
      return std::ranges::find(names, kind.name) == names.end();
    });
  return kinds;
}

// Does "snow/steep" go by the name "snow" or "snow/steep"?
bool goesBy(const std::string& scene, const std::string& name) {
  return scene == name || scene.substr(0, scene.find('/')) == name;
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
      throw Error(fmt::format("unknown scene '{}'; scenes are {}", name, fmt::join(known, ", ")));
}

void requireKnownKnobs(const std::vector<AccuracyKind>& kinds,
                       const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const AccuracyKind& kind : kinds)
    for (const std::string& knob : kind.knobs)
      if (std::ranges::find(known, knob) == known.end()) known.push_back(knob);
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      throw Error(fmt::format("unknown knob '{}'; knobs are {}", name, fmt::join(known, ", ")));
}

// The cases whose knob was asked for; all if none was.
std::vector<std::string> chosenCases(const AccuracyEffect& effect,
                                     const std::vector<std::string>& knobs) {
  std::vector<std::string> cases = effect.cases();
  if (!knobs.empty())
    std::erase_if(cases, [&](const std::string& name) {
      return std::ranges::find(knobs, knobOf(name)) == knobs.end();
    });
  return cases;
}

std::string headText(const BenchRun& run) {
  return fmt::format(
      "What accuracy costs, at {}, {} lanes, {:.0f} GFLOP/s on {:.60}\n"
      "*: the default; s.e.: the truth's own standard error; optimal: no other setting is both "
      "faster\n"
      "and closer, where times and errors within {:.0f} % and errors below s.e. count as equal; "
      "motion:\n"
      "error of changes from frame to frame; fit ratio: time before the first frame.\n\n",
      run.options().size, run.info().width, run.info().peak_gflops, run.info().device,
      100 * kAccuracyStep);
}

int runAccuracy(const CommandLine& line, const Selection& selection, BenchOptions options) {
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
  const InterruptGuard guard;
  BenchRun run(line, options);
  std::string left_out;
  for (const AccuracyKind& kind : kinds) {
    const auto effect = kind.make(run, chosenScenes(kind, options.scenes));
    run.measureCases(kAccuracyTable, chosenCases(*effect, selection.knobs),
                     {"error", "truth_stderr", "time_ratio"},
                     [&](const std::string& name) { return effect->measure(name); });
    if (const std::string left = effect->leftOut(); !left.empty()) left_out += "\n" + left + "\n";
  }
  run.addDerived(accuracyPareto(run.recordsOf(kAccuracyTable)));
  const std::vector<Record> records = run.recordsOf(kAccuracyTable);
  return run.finish(headText(run) + accuracyTableText(records) + left_out + invalidText(records));
}

}  // namespace

void addAccuracyCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<BenchOptions>();
  options->folder = "results/latest/accuracy";
  options->reps = 9;
  options->rays = 500'000'000;
  auto selection = std::make_shared<Selection>();
  Command command = app.subcommand("accuracy", "Error against time for every knob of every effect");
  command
      .option("effect", selection->effects,
              fmt::format("{} (default: all)", fmt::join(effectNames(), ", ")))
      .typeName("EFFECT");
  command
      .option("--scene", options->scenes,
              "Only these scenes, SCENE or SCENE/VIEW; repeatable (default: a few of each)")
      .oneValueEach();
  command
      .option("--knob", selection->knobs,
              "Only the settings of this knob, ka or mc_samples, say; repeatable (default: "
              "all)")
      .oneValueEach();
  command.option("--size", options->size, "Image size (default: 1920x1080)").typeName("WxH");
  command.option("--reps", options->reps, "Repetitions of every time (default: 9)");
  command.option("--rays", options->rays,
                 "Most rays of one simulation of msbrdf (default: 500000000)");
  addOutputOptions(command, *options);
  command.footer(
      "Examples:\n"
      "  glintmark accuracy\n"
      "  glintmark accuracy glints --scene dress/grazing --reps 15\n"
      "  glintmark accuracy gmm --knob lobes --knob probes\n"
      "  glintmark accuracy ltc gmm --json accuracy.json\n"
      "  glintmark accuracy msbrdf --rays 10000000");
  command.callback([options, selection, &line] {
    line.action = [options, selection, &line] { return runAccuracy(line, *selection, *options); };
  });
}

}  // namespace glintmark
