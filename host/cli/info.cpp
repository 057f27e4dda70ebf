// glintmark info: devices, and the chosen one's measured peaks.
#include <fmt/format.h>

#include "host/cli/command_line.h"
#include "host/ocl/compute.h"
#include "host/report/record/run_info.h"

namespace glintmark {
namespace {

void printDevice(const DeviceInfo& info) {
  constexpr double kGib = 1024.0 * 1024 * 1024;
  fmt::print("device {}: {}\n", info.index, info.name);
  fmt::print("  platform    {} ({})\n", info.platform, info.platform_version);
  fmt::print("  driver      {}, {}\n", info.driver_version, info.opencl_c_version);
  fmt::print("  kind        {} of {}, {} compute units at {} MHz\n", info.type, info.vendor,
             info.compute_units, info.max_clock_mhz);
  fmt::print("  memory      {:.1f} GiB, at most {:.1f} GiB in one buffer\n",
             static_cast<double>(info.global_mem_bytes) / kGib,
             static_cast<double>(info.max_alloc_bytes) / kGib);
  fmt::print("  lanes       {} (preferred float vector {})\n", info.default_lanes,
             info.preferred_float_width);
}

int runInfo(const CommandLine& line) {
  Device device = openDevice(line.common);
  fmt::print("glintmark {} ({})\n", GLINTMARK_VERSION, gitVersion());
  for (const DeviceInfo& info : listDevices()) printDevice(info);

  const int lanes = chosenLanes(line.common, device);
  ProgramCache cache(device);
  const DevicePeaks peaks = measurePeaks(device, cache, lanes);
  fmt::print("chosen: device {} with {} lanes\n", device.info().index, lanes);
  fmt::print("  FMA peak    {:.0f} GFLOP/s (measured)\n", peaks.gflops);
  fmt::print("  bandwidth   {:.1f} GB/s (measured, read + written)\n", peaks.gbs);
  return 0;
}

}  // namespace

void addInfoCommand(Command app, CommandLine& line) {
  Command command =
      app.subcommand("info", "Devices, drivers, lanes, measured FMA peak and bandwidth");
  command.footer("Examples:\n  glintmark info\n  glintmark info --device 1 --width 8");
  command.callback([&line] { line.action = [&line] { return runInfo(line); }; });
}

}  // namespace glintmark
