// What every subcommand shares: the common options, and how a subcommand registers itself.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/frame/frame_renderer.h"
#include "host/ocl/device.h"
#include "host/ocl/kernel_config.h"
#include "host/report/record.h"
#include "host/scene/load_scene.h"

namespace CLI {
class App;
}

namespace glintmark {

/// Options that stand before or after any subcommand.
struct CommonOptions {
  std::string device;  // index or name substring
  int lanes = 0;       // --width; 0: from the device
  int threads = 0;     // of the rasterizer; 0: all cores
  std::vector<std::string> overrides;
  std::string mesh_file, asset_folder;
  bool quiet = false;
};

/// One parsed command line. A subcommand's callback sets `action`, which runs after parsing and
/// returns the exit code.
struct CommandLine {
  CommonOptions common;
  std::vector<const char*> words;  // argv, for the record of the run
  std::function<int()> action;
};

void addInfoCommand(CLI::App& app, CommandLine& line);
void addRenderCommand(CLI::App& app, CommandLine& line);
void addHeatmapCommand(CLI::App& app, CommandLine& line);
void addAccuracyCommand(CLI::App& app, CommandLine& line);
void addBenchCommand(CLI::App& app, CommandLine& line);
void addSimulateCommand(CLI::App& app, CommandLine& line);
void addFitCommand(CLI::App& app, CommandLine& line);
void addCompareCommand(CLI::App& app, CommandLine& line);
void addReportCommand(CLI::App& app, CommandLine& line);
void addVerifyCommand(CLI::App& app, CommandLine& line);

struct ImageSize {
  int width_px = 1920, height_px = 1080;
};
/// Reads "WIDTHxHEIGHT". Throws Error if it is malformed, outside 1..16384, or would need more
/// memory than there is.
ImageSize parseSize(const std::string& text);

/// "zk16" or "exact"; throws Error listing the two.
GlintMethod parseMethod(const std::string& name);
std::string methodName(GlintMethod method);

/// Opens the chosen device. Throws Error for a width that kernels do not come in, DeviceError if
/// there is no such device.
Device openDevice(const CommonOptions& common);

/// Lanes that kernels will have on `device`.
int chosenLanes(const CommonOptions& common, const Device& device);

/// Loads a scene with the common options; prints its notes to stderr unless quiet.
Scene openScene(const CommonOptions& common, const std::string& name);

/// The view of that name, or the scene's first if the name is empty. Throws Error listing the known
/// ones, or if the scene has no view.
const View& chosenView(const Scene& scene, const std::string& name);

/// The host's part of RunInfo and the device's, without peaks.
RunInfo describeRun(const CommandLine& line, const Device& device);

}  // namespace glintmark
