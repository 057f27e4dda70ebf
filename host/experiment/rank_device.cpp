#include "host/experiment/rank_device.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "host/core/error.h"
#include "host/parallel/ranks.h"

namespace glintmark {
namespace {

bool only_rank_of_device = true;

std::string hostName() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

// The machine, and what a launcher may have hidden of its devices: ranks of which this is the same
// see the same devices.
std::string deviceView() {
  std::string view = hostName();
  for (const char* name : {"CUDA_VISIBLE_DEVICES", "ROCR_VISIBLE_DEVICES", "GPU_DEVICE_ORDINAL",
                           "ZE_AFFINITY_MASK", "POCL_DEVICES"}) {
    const char* value = std::getenv(name);
    view += fmt::format("|{}", value == nullptr ? "" : value);
  }
  return view;
}

// Of all ranks: throws Error at all of them if one has something to say.
void requireNoFault(const Ranks& ranks, const std::string& fault, ExitCode code) {
  for (const std::string& one : ranks.gather(fault))
    if (!one.empty()) throw Error(one, code);
}

}  // namespace

std::string rankDevice(const CommonOptions& common) {
  const Ranks& ranks = allRanks();
  if (ranks.size() == 1) return common.device;
  std::vector<int> devices;
  std::string fault;
  try {
    devices = devicesLike(common.device);
  } catch (const DeviceError& error) {
    fault = fmt::format("rank {}: {}", ranks.rank(), error.what());
  }
  requireNoFault(ranks, fault, kExitNoDevice);

  const std::vector<std::string> views = ranks.gather(deviceView());
  const std::string& own = views[static_cast<std::size_t>(ranks.rank())];
  const auto here = static_cast<std::size_t>(std::ranges::count(views, own));
  const auto place =
      static_cast<std::size_t>(std::count(views.begin(), views.begin() + ranks.rank(), own));
  const DeviceInfo info = listDevices()[static_cast<std::size_t>(devices.front())];
  only_rank_of_device = place < devices.size();
  if (here > devices.size() && (!info.is_cpu || common.own_device))
    fault = fmt::format(
        "ranks without devices: {} ranks on {} have {} of '{}'; start one rank per device{}", here,
        hostName(), devices.size(), info.name,
        info.is_cpu ? ", since what is timed runs alone on it" : "");
  requireNoFault(ranks, fault, kExitBadInput);
  if (here > devices.size() && !common.quiet)
    fmt::print(stderr,
               "note: {} ranks share '{}' on {}, with {} threads of the driver each; mpirun "
               "--bind-to core with POCL_MAX_PTHREAD_COUNT=1 gives each its own core\n",
               here, info.name, hostName(), info.compute_units);
  return std::to_string(devices[place % devices.size()]);
}

bool timesOnItsDevice() {
  return only_rank_of_device;
}

void requireOneKind(const DeviceInfo& info) {
  const Ranks& ranks = allRanks();
  const std::vector<std::string> kinds =
      ranks.gather(fmt::format("'{}', driver {}", info.name, info.driver_version));
  const auto other =
      std::ranges::find_if(kinds, [&](const std::string& kind) { return kind != kinds.front(); });
  if (other == kinds.end()) return;
  throw Error(fmt::format(
      "rank {} has device {}, but rank 0 has {}; a run is of one kind, which --device chooses",
      other - kinds.begin(), *other, kinds.front()));
}

}  // namespace glintmark
