// glintmark accuracy: what each knob's accuracy costs in time.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/output_options.h"
#include "host/experiment/accuracy/accuracy_run.h"

namespace glintmark {

void addAccuracyCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<BenchOptions>();
  options->folder = "results/latest/accuracy";
  options->reps = 9;
  options->rays = 500'000'000;
  auto selection = std::make_shared<AccuracySelection>();
  Command command = app.subcommand("accuracy", "Error against time for every knob of every effect");
  command
      .option("effect", selection->effects,
              fmt::format("{} (default: all)", fmt::join(accuracyEffects(), ", ")))
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
    line.shares_work = true;
    line.action = [options, selection, &line] { return runAccuracy(line, *selection, *options); };
  });
}

}  // namespace glintmark
