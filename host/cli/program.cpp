#include "host/cli/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "host/cli/command_line.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/experiment/rank_watch.h"
#include "host/experiment/survival.h"
#include "host/parallel/ranks.h"
#include "host/report/record/machine.h"
#include "host/report/record/run_info.h"

namespace glintmark {
namespace {

constexpr const char* kDescription =
    "glintmark measures what micro-detail shading costs and what its accuracy costs.";
constexpr const char* kExamples =
    "Examples:\n"
    "  glintmark info\n"
    "  glintmark render sand -o sand.png --star\n"
    "  glintmark heatmap sponza --view grazing -o cells.png\n"
    "  glintmark bench zk16\n"
    "Every subcommand has its own --help.\n"
    "Exit codes: 0 done, 1 a check failed or a picture is black, empty or not finite, 2 bad usage\n"
    "or input, 3 no usable device, 129, 130 and 143 ended by SIGHUP, Ctrl-C and SIGTERM.";

void addCommonOptions(Command app, CommonOptions& common) {
  app.option("--device", common.device, "OpenCL device: its index in 'info' or part of its name")
      .typeName("I|NAME");
  app.option("--width", common.lanes, "Lanes per work-item: 1, 4, 8 or 16 (default: device's)")
      .typeName("W");
  app.option("--timer", common.timer,
             "Clock of kernels: auto (the device's while it makes sense), device or wall")
      .typeName("CLOCK");
  app.option("--threads", common.threads, "Rasterizer threads (default: all cores that it may use)")
      .typeName("N")
      .nonNegative();
  app.option("--set", common.overrides, "Changes a value of the scene file; repeatable")
      .typeName("KEY=VALUE")
      .oneValueEach();
  app.option("--mesh", common.mesh_file, "Mesh (OBJ, glTF, PLY) in place of the scene's own")
      .typeName("FILE");
  app.option("--assets", common.asset_folder, "Folder with the real meshes that scenes name")
      .typeName("FOLDER");
  app.flag("--quiet", common.quiet, "No progress and no notes on stderr");
}

// What is printed is the first rank's.
void muteOutput() {
  if (std::freopen("/dev/null", "w", stdout) == nullptr)
    throw Error("cannot open /dev/null for what a rank prints");
}

// Joins the ranks of mpirun, if there are any, and shares the processors of this machine out.
void joinRanksOf(CommandLine& line) {
  if (!line.shares_work && launched().size > 1)
    throw Error(fmt::format(
        "this command does not share its work among {} ranks; start it without mpirun, or share "
        "simulate, accuracy, bench or fit",
        launched().size));
  watchRank();
  joinRanks();
  const Ranks& ranks = allRanks();
  if (!ranks.isFirst()) line.common.quiet = true;
  // Threads beyond a control group's quota would only wait for each other; ranks that are not bound
  // to processors of their own all see the same ones.
  if (line.common.threads != 0) return;
  const auto all = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  line.common.threads = std::min(usableCores(), std::max(1, all / ranks.onThisMachine()));
}

}  // namespace

int runProgram(int argc, const char* const* argv) {
  CommandLine line;
  line.words.assign(argv, argv + argc);

  CommandParser parser("glintmark", kDescription,
                       fmt::format("glintmark {} ({})", GLINTMARK_VERSION, gitVersion()));
  Command app = parser.program();
  app.footer(kExamples);
  app.requireSubcommand();
  addCommonOptions(app, line.common);
  addInfoCommand(app, line);
  addRenderCommand(app, line);
  addHeatmapCommand(app, line);
  addExportCommand(app, line);
  addBenchCommand(app, line);
  addAccuracyCommand(app, line);
  addScaleCommand(app, line);
  addSimulateCommand(app, line);
  addFitCommand(app, line);
  addCompareCommand(app, line);
  addDiffCommand(app, line);
  addReportCommand(app, line);
  addProfileCommand(app, line);
  addVerifyCommand(app, line);
  app.shareOptions();

  if (launched().rank > 0) muteOutput();
  if (const std::optional<int> done = parser.parse(argc, argv)) return *done;
  if (const std::string& assets = line.common.asset_folder;
      !assets.empty() && !std::filesystem::is_directory(assets))
    throw Error(fmt::format("--assets '{}' is not a folder", assets));
  joinRanksOf(line);
  const InputGuard guard;
  if (line.common.quiet) Progress::silenceAll();
  return line.opens_device ? runWatched(line.action) : line.action();
}

}  // namespace glintmark
