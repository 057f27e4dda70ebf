// glintmark scale: one view over pixels, lanes and compute units.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/output_options.h"
#include "host/experiment/scaling/scaling_run.h"
#include "host/frame/shading_options.h"

namespace glintmark {

void addScaleCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<BenchOptions>();
  options->folder = "results/latest/scale";
  auto selection = std::make_shared<ScalingSelection>();
  Command command =
      app.subcommand("scale", "Time of a view over resolution, lanes of work-items and threads");
  command.option("scene", selection->scene, "Scene name or file").required().typeName("SCENE");
  command.option("--view", selection->view, "View (default: the scene's first)");
  command
      .option("--axis", selection->knobs,
              fmt::format("Only this axis: {}; repeatable", fmt::join(scalingKnobs(), ", ")))
      .oneValueEach();
  command
      .option("--up-to", selection->most_height_px,
              "Largest height of axis height, from 360 on (default: 4320, 8K)")
      .typeName("PIXELS");
  command.option("--size", options->size, "Image size of the other axes (default: 1920x1080)")
      .typeName("WxH");
  command.option("--method", options->method, methodHelp());
  command.option("--reps", options->reps, "Repetitions of every measurement (default: 9)");
  addOutputOptions(command, *options);
  command.footer(
      "Examples:\n"
      "  glintmark scale sponza --view grazing\n"
      "  glintmark scale snow --axis threads --reps 15\n"
      "  glintmark scale snow --up-to 2160 -o results/scale\n"
      "  glintmark report results/scale");
  command.callback([options, selection, &line] {
    options->scenes = {selection->scene};
    line.action = [options, selection, &line] { return runScaling(line, *selection, *options); };
  });
}

}  // namespace glintmark
