#include "host/experiment/session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <span>

#include "host/core/error.h"
#include "host/experiment/rank_device.h"
#include "host/frame/map_room.h"
#include "host/ocl/device_clock.h"
#include "host/ocl/driver_cache.h"
#include "host/ocl/trial.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/run_info.h"

namespace glintmark {
namespace {

constexpr int kMaxSize = 16384;
// Host and device memory of one rendered frame, measured: planes on both sides, radiance on the
// device and twice on the host, visibility buffer, counts and pictures. bench takes 198.
constexpr unsigned long long kBytesPerPixel = 200;

bool parseInt(const char*& cursor, const char* end, int& value) {
  const auto [next, error] = std::from_chars(cursor, end, value);
  cursor = next;
  return error == std::errc();
}

TimerChoice parseTimer(const std::string& text) {
  if (text == "auto") return TimerChoice::kAuto;
  if (text == "device") return TimerChoice::kDevice;
  if (text == "wall") return TimerChoice::kWall;
  throw Error(fmt::format("--timer '{}' is none of auto, device and wall", text));
}

}  // namespace

ImageSize parseSize(const std::string& text) {
  ImageSize size;
  const char* cursor = text.data();
  const char* end = cursor + text.size();
  const bool well_formed = parseInt(cursor, end, size.width_px) && cursor != end &&
                           *cursor++ == 'x' && parseInt(cursor, end, size.height_px) &&
                           cursor == end;
  const auto in_range = [](int length) { return length >= 1 && length <= kMaxSize; };
  if (!well_formed || !in_range(size.width_px) || !in_range(size.height_px)) {
    throw Error(
        fmt::format("--size '{}' is not WIDTHxHEIGHT with each from 1 to {}, for example "
                    "1920x1080",
                    text, kMaxSize));
  }
  const unsigned long long needed =
      kBytesPerPixel * static_cast<unsigned long long>(size.width_px) * size.height_px;
  const unsigned long long available = availableMemoryBytes();
  if (available != 0 && needed > available) {
    throw Error(
        fmt::format("--size {} needs about {:.1f} GB of memory, but {:.1f} GB are free; "
                    "choose a smaller size",
                    text, needed * 1e-9, available * 1e-9));
  }
  return size;
}

void prepareDrivers(const CommonOptions& common) {
  const int lanes = common.lanes;
  if (lanes != 0 && std::ranges::find(kLaneCounts, lanes) == kLaneCounts.end())
    throw Error(fmt::format("--width {} is not a lane count; use {} or {}", lanes,
                            fmt::join(std::span(kLaneCounts).first(kLaneCounts.size() - 1), ", "),
                            kLaneCounts.back()));
  parseTimer(common.timer);
  const std::string note = prepareDriverCache();
  if (!note.empty() && !common.quiet) fmt::print(stderr, "note: {}\n", note);
}

Device openUntried(const CommonOptions& common) {
  prepareDrivers(common);
  Device device(rankDevice(common), parseTimer(common.timer));
  requireOneKind(device.info());
  if (!common.quiet)
    device.clock().onDistrust(
        [](const std::string& why) { fmt::print(stderr, "note: {}\n", why); });
  return device;
}

Device openDevice(const CommonOptions& common) {
  Device device = openUntried(common);
  tryDevice(device, chosenLanes(common, device));
  return device;
}

int chosenLanes(const CommonOptions& common, const Device& device) {
  return common.lanes != 0 ? common.lanes : device.info().default_lanes;
}

Scene openScene(const CommonOptions& common, const std::string& name,
                const std::function<void(const Scene&)>& before_maps) {
  Scene scene = loadScene({.scene = name,
                           .overrides = common.overrides,
                           .mesh_file = common.mesh_file,
                           .asset_folder = common.asset_folder,
                           .image_loader = readColours,
                           .normal_loader = readNormals,
                           .normal_size = normalsSize,
                           .before_maps = before_maps,
                           .image_decoder = decodeNormals});
  if (!common.quiet) {
    for (const std::string& note : scene.notes) fmt::print(stderr, "note: {}\n", note);
  }
  return scene;
}

Scene openScene(const CommonOptions& common, const std::string& name, const ShadingOptions& shading,
                bool truth) {
  return openScene(common, name, [&](const Scene& scene) {
    requireRoomForMaps(scene, shading, truth, [&] { return openUntried(common).info(); });
  });
}

const View& chosenView(const Scene& scene, const std::string& name) {
  if (!name.empty()) return scene.view(name);
  if (scene.views.empty()) throw Error(fmt::format("scene '{}' has no view", scene.name));
  return scene.views.front();
}

RunInfo describeRun(const Session& session, const Device& device) {
  RunInfo run = describeHost(session.words);
  const DeviceInfo& info = device.info();
  run.device = info.name;
  run.driver = info.driver_version;
  run.platform = info.platform + " " + info.platform_version;
  run.width = chosenLanes(session.common, device);
  return run;
}

}  // namespace glintmark
