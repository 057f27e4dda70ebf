// glintmark heatmap: cells visited per pixel, of one view or over a sweep of angles. [ZK16] Fig. 9
#include <fmt/format.h>

#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/shading_flags.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/unknown_name.h"
#include "host/experiment/angle_sweep.h"
#include "host/experiment/count_cells.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/shading_options.h"
#include "host/report/picture/heatmap.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {
namespace {

struct HeatmapCommand {
  std::string scene = "screen_plane", view, size;
  std::string picture, exr, csv;
  std::string scale = "fixed";
  ShadingFlags flags{defaultMethod()};
  bool sweep_angle = false, scale_given = false;
};

HeatmapScale parseScale(const std::string& name) {
  if (name == "fixed") return HeatmapScale::kFixed;
  if (name == "auto") return HeatmapScale::kAuto;
  throw Error(unknownName("scale", name, std::vector<std::string>{"fixed", "auto"}));
}

void checkOutputs(const HeatmapCommand& command) {
  const auto check = [](const std::string& file, const char* option, const char* extension) {
    if (!file.empty() && std::filesystem::path(file).extension() != extension)
      throw Error(fmt::format("{} '{}' must end in {}", option, file, extension));
  };
  check(command.picture, "--output", ".png");
  check(command.exr, "--exr", ".exr");
  check(command.csv, "--csv", ".csv");
  announceOutputs({{"-o", command.picture}, {"--exr", command.exr}, {"--csv", command.csv}});
  if (command.sweep_angle && !command.exr.empty()) {
    throw Error("--exr holds one view; it does not go with --sweep-angle");
  }
  parseScale(command.scale);  // refuses what there is not
  if (command.scale_given && command.picture.empty())
    throw Error("--scale is of the picture; add -o FILE.png");
  if (!command.sweep_angle && !command.csv.empty()) {
    throw Error("--csv holds a sweep; it needs --sweep-angle");
  }
}

int runView(const CommonOptions& common, const HeatmapCommand& command,
            const ShadingOptions& shading) {
  const HeatmapScale scale = parseScale(command.scale);
  const Scene scene = openScene(common, command.scene, shading);
  const View& view = chosenView(scene, command.view);
  command.flags.noteIdle(scene, shading, common.quiet);
  Device device = openDevice(common);
  const CountedCells counted = countCells(device, scene, view, shading, common.threads);

  if (counted.counts.glint_px == 0)
    throw Error(
        fmt::format("no pixel of view {} of {} shows lit glints, so there are no cells to count",
                    view.name, scene.name));
  const std::string name = scene.name + "/" + view.name;
  const std::string unit = visitedUnit(shading.method);
  if (!command.picture.empty()) {
    const Image picture = heatmapPicture(counted.cells, {.scale = scale,
                                                         .title = name + ", " + unit + " per pixel",
                                                         .guard_hits = counted.counts.guard_hits});
    writePng(picture, command.picture);
  }
  if (!command.exr.empty()) {
    Image cells = counted.cells;
    cells.channel_names = {"cells"};
    writeExr(cells, command.exr);
  }
  printText("{} {}x{}, {} per pixel over {} glint pixels\n", name, shading.width_px,
            shading.height_px, unit, counted.counts.glint_px);
  printText("min {}  mean {:.3f}  max {}  guard hits {}\n", counted.counts.min, counted.counts.mean,
            counted.counts.max, counted.counts.guard_hits);
  printText("mean {:.3f} with idle lanes and steps rounded up\n", counted.counts.paid_mean);
  fmt::print("{}", histogramText(cellDistribution(counted.cells), terminalColumns()));
  return kExitDone;
}

int runHeatmap(const CommonOptions& common, const HeatmapCommand& command) {
  checkOutputs(command);
  const char* default_size = command.sweep_angle ? "960x540" : "1920x1080";
  const ImageSize size = parseSize(command.size.empty() ? default_size : command.size);
  ShadingOptions shading{
      .width_px = size.width_px, .height_px = size.height_px, .lanes = common.lanes};
  command.flags.apply(shading);
  if (!command.sweep_angle) return runView(common, command, shading);
  return runAngleSweep(common, {.scene = command.scene,
                                .view = command.view.empty() ? "sweep" : command.view,
                                .shading = shading,
                                .scale = parseScale(command.scale),
                                .picture = command.picture,
                                .csv = command.csv});
}

}  // namespace

void addHeatmapCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<HeatmapCommand>();
  Command command =
      app.subcommand("heatmap", "Cells visited per pixel: picture, counts, histogram");
  command.option("scene", options->scene, "Scene name or .toml file (default: screen_plane)")
      .typeName("SCENE");
  command.option("-o,--output", options->picture, "False-colour picture with legend")
      .typeName("FILE.png");
  command.option("--exr", options->exr, "Raw counts; -1 where no glint material covers")
      .typeName("FILE.exr");
  command.option("--view", options->view, "View of the scene (default: its first; sweep: sweep)");
  command.option("--size", options->size, "Image size (default: 1920x1080; sweep: 960x540)")
      .typeName("WxH");
  const CommandOption scale =
      command.option("--scale", options->scale, "fixed (8 to 64 cells) or auto (default: fixed)");
  options->flags.addGlintOptions(command);
  command.flag("--sweep-angle", options->sweep_angle,
               "A view that orbits a plane, from 90 to 1 degrees: picture strip and CSV");
  command.option("--csv", options->csv, "Figures of the sweep, one line per angle")
      .typeName("FILE.csv");
  command.footer(
      "Examples:\n"
      "  glintmark heatmap sponza --view grazing -o cells.png --exr cells.exr\n"
      "  glintmark heatmap snow -o cells.png --scale auto --size 960x540\n"
      "  glintmark heatmap --sweep-angle -o sweep.png --csv sweep.csv");
  command.callback([options, scale, &line] {
    options->scale_given = scale.given();
    line.opens_device = true;
    line.action = [options, &line] { return runHeatmap(line.common, *options); };
  });
}

}  // namespace glintmark
