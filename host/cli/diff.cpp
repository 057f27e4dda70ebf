// glintmark diff: one picture against another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <memory>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/report/difference/difference_picture.h"
#include "host/report/difference/image_difference.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {
namespace {

struct DiffOptions {
  std::string picture, reference, output, json, map;
  DifferenceOptions difference;
  double trim_percent = 0.1;
  std::optional<double> top;
  bool no_hdr = false;
};

void requirePositive(const char* option, double value) {
  if (!(value > 0 && std::isfinite(value)))
    throw Error(fmt::format("{} {} is not a positive number", option, value));
}

void checkDiffOptions(const DiffOptions& options) {
  requirePositive("--exposure", options.difference.exposure);
  requirePositive("--ppd", options.difference.pixels_per_degree);
  if (options.top) requirePositive("--max", *options.top);
  if (options.difference.pixels_per_degree > 1000)
    throw Error(fmt::format("--ppd {} is more than 1000 pixels per degree",
                            options.difference.pixels_per_degree));
  if (!(options.trim_percent >= 0 && options.trim_percent <= 50))
    throw Error(fmt::format("--trim {} is not a percentage from 0 to 50", options.trim_percent));
  if (!options.output.empty()) requireImageExtension(options.output);
  announceOutputs({{"-o", options.output}, {"--json", options.json}});
}

// The map that --map names, and what is written beside its colours.
const Image& chosenMap(const ImageDifference& d, const std::string& name) {
  std::map<std::string, const Image*> maps = {
      {"flip", &d.flip}, {"absolute", &d.absolute}, {"relative", &d.relative}};
  if (d.hdr_flip) maps["hdr_flip"] = &*d.hdr_flip;
  std::vector<std::string> names;
  for (const auto& [known, map] : maps) names.push_back(known);
  if (!maps.contains(name))
    throw Error(fmt::format("no map of these pictures is called '{}'; maps are {}", name,
                            fmt::join(names, ", ")));
  return *maps.at(name);
}

// FLIP ends at 1; other errors where all but a thousandth of the pixels that are not black do.
double topOf(const ImageDifference& d, const DiffOptions& options) {
  if (options.top) return *options.top;
  if (options.map.ends_with("flip")) return 1;
  for (const ErrorQuantiles& quantiles : d.quantiles)
    if (quantiles.name == options.map && quantiles.values[3] > 0) return quantiles.values[3];
  return 1;
}

int runDiff(const DiffOptions& options) {
  checkDiffOptions(options);
  const Image picture = readColours(options.picture), reference = readColours(options.reference);
  const ImageDifference d = differenceOf(picture, reference, options.difference);
  if (!options.output.empty()) {
    const Image& map = chosenMap(d, options.map);
    const double top = topOf(d, options);
    const std::string title = fmt::format("{} error", options.map);
    if (requireImageExtension(options.output) == ".png")
      writePng(differencePicture(map, top, title), options.output);
    else
      writeExr(differenceLayers(map, top, title, options.map), options.output);
  }
  if (!options.json.empty())
    writeFile(options.json, differenceJson(d, options.picture, options.reference));
  printText("{}", differenceText(d, options.picture, options.reference));
  return kExitDone;
}

}  // namespace

void addDiffCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<DiffOptions>();
  options->map = "flip";
  Command command = app.subcommand("diff", "Error metrics of one picture against another");
  command.option("picture", options->picture, "Picture, FILE or FILE#LAYER")
      .required()
      .typeName("FILE");
  command.option("reference", options->reference, "What it is held against, of the same size")
      .required()
      .typeName("FILE");
  command.option("-o,--output", options->output, "Errors in false colours: .png, or .exr with them")
      .typeName("FILE");
  command.option("--map", options->map,
                 "Errors that -o shows: flip, hdr_flip, absolute or relative (default: flip)");
  command.option("--max", options->top, "Error at the end of its colours").typeName("X");
  command
      .option("--exposure", options->difference.exposure,
              "Scale of radiance before it is displayed (default: 1)")
      .typeName("X");
  command
      .option("--ppd", options->difference.pixels_per_degree,
              "Pixels per degree of the eye, for FLIP (default: 67)")
      .typeName("N");
  command
      .option("--trim", options->trim_percent,
              "Worst pixels that the trimmed relMSE leaves out [%] (default: 0.1)")
      .typeName("PERCENT");
  command.flag("--no-hdr", options->no_hdr, "Leaves HDR-FLIP out, which takes most of the time");
  command.option("--json", options->json, "Also writes the metrics to this file").typeName("FILE");
  command.footer(
      "The first picture is judged by the second. A mean over all pixels says little of sparse\n"
      "glints, so each metric also stands over the pixels that are not black in both.\n"
      "Examples:\n"
      "  glintmark diff zk16.exr exact.exr -o error.png\n"
      "  glintmark diff a.png b.png --json metrics.json\n"
      "  glintmark diff a.exr b.exr -o error.exr --map relative --max 0.5");
  command.callback([options, &line] {
    options->difference.trim = options->trim_percent / 100;
    options->difference.hdr_flip = !options->no_hdr;
    line.action = [options] { return runDiff(*options); };
  });
}

}  // namespace glintmark
