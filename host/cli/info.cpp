// glintmark info: every platform and device, what is wrong with each, and the chosen one's measured
// peaks.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/ocl/compute.h"
#include "host/ocl/device_clock.h"
#include "host/report/record/run_info.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {
namespace {

struct InfoOptions {
  std::string json;
};

struct ChosenDevice {
  int index = 0, lanes = 1;
  DevicePeaks peaks;
  Timer timer = Timer::kDevice;
};

template <typename T>
std::string orUnknown(T value, const char* unit) {
  return value == 0 ? "unknown" : fmt::format("{}{}", value, unit);
}

std::string gibibytes(unsigned long long bytes) {
  constexpr double kGib = 1024.0 * 1024 * 1024;
  return bytes == 0 ? "unknown" : fmt::format("{:.1f} GiB", static_cast<double>(bytes) / kGib);
}

void printDevice(const DeviceInfo& info) {
  printText("device {}: {}\n", info.index, info.name);
  if (!info.problem.empty()) printText("  problem     {}\n", info.problem);
  printText("  platform    {} ({})\n", info.platform, info.platform_version);
  printText("  driver      {}, {}\n", info.driver_version, info.opencl_c_version);
  printText("  kind        {} of {}, compute units: {}, clock: {}\n", info.type, info.vendor,
            orUnknown(info.compute_units, ""), orUnknown(info.max_clock_mhz, " MHz"));
  printText("  memory      {}, at most {} in one buffer\n", gibibytes(info.global_mem_bytes),
            gibibytes(info.max_alloc_bytes));
  printText("  groups      at most {} work-items\n", orUnknown(info.max_work_group_size, ""));
  printText("  lanes       {} (preferred float vector {})\n", info.default_lanes,
            orUnknown(info.preferred_float_width, ""));
  if (!info.refused.empty()) printText("  refused     {}\n", fmt::join(info.refused, ", "));
}

void printPlatforms(const PlatformList& list) {
  if (!list.problem.empty()) printText("problem: {}\n", list.problem);
  for (const std::string& broken : list.broken_drivers) printText("broken driver {}\n", broken);
  for (const PlatformInfo& platform : list.platforms) {
    if (!platform.problem.empty())
      printText("platform {} ({}): {}\n", platform.name, platform.version, platform.problem);
    for (const DeviceInfo& info : platform.devices) printDevice(info);
  }
}

nlohmann::ordered_json deviceJson(const DeviceInfo& info) {
  return {{"index", info.index},
          {"name", info.name},
          {"problem", info.problem},
          {"vendor", info.vendor},
          {"type", info.type},
          {"driver", info.driver_version},
          {"opencl_c", info.opencl_c_version},
          {"compute_units", info.compute_units},
          {"max_clock_mhz", info.max_clock_mhz},
          {"global_mem_bytes", info.global_mem_bytes},
          {"max_alloc_bytes", info.max_alloc_bytes},
          {"local_mem_bytes", info.local_mem_bytes},
          {"cache_bytes", info.cache_bytes},
          {"max_work_group_size", info.max_work_group_size},
          {"preferred_float_width", info.preferred_float_width},
          {"timer_resolution_ns", info.timer_resolution_ns},
          {"lanes", info.default_lanes},
          {"refused", info.refused}};
}

std::string infoJson(const PlatformList& list, const std::optional<ChosenDevice>& chosen,
                     const std::string& why_not) {
  nlohmann::ordered_json json = {{"schema", "glintmark.info/1"},
                                 {"version", GLINTMARK_VERSION},
                                 {"git", gitVersion()},
                                 {"problem", list.problem},
                                 {"broken_drivers", list.broken_drivers},
                                 {"platforms", nlohmann::ordered_json::array()},
                                 {"chosen", nullptr},
                                 {"why_none_chosen", why_not}};
  for (const PlatformInfo& platform : list.platforms) {
    nlohmann::ordered_json devices = nlohmann::ordered_json::array();
    for (const DeviceInfo& info : platform.devices) devices.push_back(deviceJson(info));
    json["platforms"].push_back({{"name", platform.name},
                                 {"version", platform.version},
                                 {"vendor", platform.vendor},
                                 {"problem", platform.problem},
                                 {"devices", std::move(devices)}});
  }
  if (chosen)
    json["chosen"] = {{"index", chosen->index},
                      {"lanes", chosen->lanes},
                      {"peak_gflops", chosen->peaks.gflops},
                      {"peak_gbs", chosen->peaks.gbs},
                      {"timer", timerName(chosen->timer)}};
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

ChosenDevice measureChosen(const CommonOptions& common) {
  Device device = openDevice(common);
  const int lanes = chosenLanes(common, device);
  ProgramCache cache(device);
  const DevicePeaks peaks = measurePeaks(device, cache, lanes);
  return {device.info().index, lanes, peaks, device.clock().timer()};
}

void printChosen(const ChosenDevice& chosen) {
  const char* how = chosen.timer == Timer::kWall ? "measured by the wall clock" : "measured";
  printText("chosen: device {} with {} lanes\n", chosen.index, chosen.lanes);
  printText("  FMA peak    {:.3g} GFLOP/s ({})\n", chosen.peaks.gflops, how);
  printText("  bandwidth   {:.3g} GB/s ({}, read + written)\n", chosen.peaks.gbs, how);
}

// The list comes first and whatever happens: it says why a device cannot be used.
int runInfo(const CommandLine& line, const InfoOptions& options) {
  announceOutputs({{"--json", options.json}});
  prepareDrivers(line.common);
  const PlatformList list = listPlatforms();
  printText("glintmark {} ({})\n", GLINTMARK_VERSION, gitVersion());
  printPlatforms(list);
  std::fflush(stdout);
  try {
    const ChosenDevice chosen = measureChosen(line.common);
    printChosen(chosen);
    if (!options.json.empty()) writeFile(options.json, infoJson(list, chosen, ""));
  } catch (const Error& error) {
    if (!options.json.empty()) writeFile(options.json, infoJson(list, std::nullopt, error.what()));
    throw;
  }
  return 0;
}

}  // namespace

void addInfoCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<InfoOptions>();
  Command command =
      app.subcommand("info", "Platforms, devices, drivers, lanes, measured FMA peak and bandwidth");
  command.option("--json", options->json, "Also writes all of it to this file").typeName("FILE");
  command.footer(
      "Examples:\n  glintmark info\n  glintmark info --device 1 --width 8 --json info.json");
  command.callback([options, &line] {
    line.opens_device = true;
    line.action = [options, &line] { return runInfo(line, *options); };
  });
}

}  // namespace glintmark
