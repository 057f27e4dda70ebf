// What every measurement needs of the program around it: the common options, the device, a scene.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "host/frame/shading_options.h"
#include "host/ocl/device.h"
#include "host/report/record/record.h"
#include "host/scene/load_scene.h"

namespace glintmark {

/// Lanes that kernels come in.
inline constexpr std::array kLaneCounts = {1, 4, 8, 16};

/// Options that stand before or after any subcommand.
struct CommonOptions {
  std::string device;          // index or name substring
  int lanes = 0;               // --width; 0: from the device
  std::string timer = "auto";  // of kernels: auto, device, wall
  int threads = 0;             // of the rasterizer; 0: all cores
  std::vector<std::string> overrides;
  std::string mesh_file, asset_folder;
  bool quiet = false;
  bool own_device = false;  // a rank must not share its device with others
};

/// What one call of the program was asked for, whatever its subcommand.
struct Session {
  CommonOptions common;
  std::vector<const char*> words;  // argv, for the record of the run
};

struct ImageSize {
  int width_px = 1920, height_px = 1080;
};
/// Reads "WIDTHxHEIGHT". Throws Error if it is malformed, outside 1..16384, or would need more
/// memory than there is.
ImageSize parseSize(const std::string& text);

/// Checks the options that choose how kernels run, gives drivers what they need of the system,
/// once, and says so on stderr unless quiet. For what comes before openDevice(), which does it too.
/// Throws Error like openDevice().
void prepareDrivers(const CommonOptions& common);

/// Opens the chosen device. Unless quiet, it says on stderr if its clock turns out to be of no use.
/// Throws Error for a width that kernels do not come in or an unknown timer, DeviceError if there
/// is no such device. Of all ranks: each opens another of the devices that are like the chosen one
/// on its machine; where they are processors and too few, ranks share them, unless each is to have
/// its `own_device`. Throws Error if there are not enough, or of several kinds.
Device openUntried(const CommonOptions& common);

/// The same, and tries what it computes. Throws DeviceError if that is wrong.
Device openDevice(const CommonOptions& common);

/// Is this the only rank that opened its device, or the first of those that share it?
bool timesOnItsDevice();

/// Lanes that kernels will have on `device`.
int chosenLanes(const CommonOptions& common, const Device& device);

/// Loads a scene with the common options; prints its notes to stderr unless quiet. `before_maps`:
/// see SceneRequest.
Scene openScene(const CommonOptions& common, const std::string& name,
                const std::function<void(const Scene&)>& before_maps = {});
/// The same of a scene that will be shaded so, or sampled for the truth: throws Error before normal
/// maps are made for which there is no room.
Scene openScene(const CommonOptions& common, const std::string& name, const ShadingOptions& shading,
                bool truth = false);

/// The view of that name, or the scene's first if the name is empty. Throws Error listing the known
/// ones, or if the scene has no view.
const View& chosenView(const Scene& scene, const std::string& name);

/// The host's part of RunInfo and the device's, without peaks.
RunInfo describeRun(const Session& session, const Device& device);

}  // namespace glintmark
