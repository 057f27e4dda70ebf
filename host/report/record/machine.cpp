#include "host/report/record/machine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/core/control_group.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

constexpr double kMovedPeak = 0.1;        // of the peak at the start
constexpr double kBusyShare = 0.15;       // of the processors, used by others
constexpr double kThrottledShareS = 0.5;  // taken by a quota in the whole run

double leastQuota(const fs::path& root) {
  double cores = INFINITY;
  for (const fs::path& folder : groupFolders(root, "")) {
    std::ifstream stream(folder / "cpu.max");
    std::string quota;
    double period = 0;
    if (stream >> quota >> period && quota != "max" && period > 0)
      cores = std::min(cores, std::atof(quota.c_str()) / period);
  }
  for (const fs::path& folder : groupFolders(root, "cpu")) {
    const auto quota = readNumber(folder / "cpu.cfs_quota_us");
    const auto period = readNumber(folder / "cpu.cfs_period_us");
    if (quota && period && *quota > 0 && *period > 0) cores = std::min(cores, *quota / *period);
  }
  return cores;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double ownSeconds() {
  double total = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage = {};
    if (getrusage(who, &usage) == 0) total += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return total;
}

// Those that this process may run on; false if nobody says.
bool allowedCpus(cpu_set_t& set) {
  CPU_ZERO(&set);
  // Machines with more processors than a set holds have them all.
  return sched_getaffinity(0, sizeof set, &set) == 0;
}

// Time that processors which this process may run on were neither idle nor waiting for disks,
// stolen time included.
double allSeconds(const fs::path& root) {
  cpu_set_t allowed;
  const bool chosen = allowedCpus(allowed);
  std::ifstream stream(root / "proc/stat");
  double all = 0, ours = 0;
  bool found = false;  // lines of single processors
  for (std::string line; std::getline(stream, line) && line.starts_with("cpu");) {
    std::istringstream words(line);
    std::string cpu;
    double user = 0, nice = 0, system = 0, idle = 0, wait = 0, irq = 0, soft = 0, steal = 0;
    words >> cpu >> user >> nice >> system >> idle >> wait >> irq >> soft >> steal;
    const double busy = user + nice + system + irq + soft + steal;
    if (cpu == "cpu")
      all = busy;
    else if (chosen && CPU_ISSET(std::strtoul(cpu.c_str() + 3, nullptr, 10), &allowed))
      ours += busy, found = true;
  }
  return (found ? ours : all) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double throttled(const fs::path& root) {
  for (const fs::path& folder : groupFolders(root, ""))
    if (const auto us = numberAfter(folder / "cpu.stat", "throttled_usec")) return *us * 1e-6;
  for (const fs::path& folder : groupFolders(root, "cpu"))
    if (const auto ns = numberAfter(folder / "cpu.stat", "throttled_time")) return *ns * 1e-9;
  return 0;
}

}  // namespace

int usableCores(const fs::path& root) {
  cpu_set_t set;
  const double allowed = allowedCpus(set) ? CPU_COUNT(&set) : std::thread::hardware_concurrency();
  return static_cast<int>(std::max(1.0, std::min(allowed, std::ceil(leastQuota(root)))));
}

MachineState machineState(const fs::path& root) {
  MachineState state;
  state.load = readNumber(root / "proc/loadavg").value_or(0);
  std::ifstream stream(root / "proc/cpuinfo");
  double sum = 0;
  int count = 0;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("cpu MHz")) continue;
    sum += std::atof(line.c_str() + line.find(':') + 1);
    ++count;
  }
  if (count > 0) state.clock_mhz = sum / count;
  return state;
}

MachineWatch::MachineWatch(fs::path root) : root_(std::move(root)), start_(now()) {}

MachineWatch::Times MachineWatch::now() const {
  const auto clock = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(clock).count(), allSeconds(root_), ownSeconds(),
          throttled(root_)};
}

double MachineWatch::othersCores() const {
  const Times end = now();
  const double wall_s = end.wall_s - start_.wall_s;
  const double others_s = (end.all_s - start_.all_s) - (end.own_s - start_.own_s);
  return wall_s > 0 ? std::max(0.0, others_s / wall_s) : 0;
}

double MachineWatch::throttledSeconds() const {
  return std::max(0.0, now().throttled_s - start_.throttled_s);
}

std::string busyText(const RunInfo& run) {
  std::vector<std::string> reasons;
  const auto moved = [&](const char* what, const char* unit, double begin, double end) {
    if (begin > 0 && end > 0 && std::abs(end / begin - 1) > kMovedPeak)
      reasons.push_back(
          fmt::format("its {} moved from {:.3g} to {:.3g} {}", what, begin, end, unit));
  };
  moved("FMA peak", "GFLOP/s", run.begin.peak_gflops, run.end.peak_gflops);
  moved("bandwidth", "GB/s", run.begin.peak_gbs, run.end.peak_gbs);
  if (run.cores > 0 && run.others_cores > kBusyShare * run.cores)
    reasons.push_back(
        fmt::format("others kept {:.1f} of {} processors busy", run.others_cores, run.cores));
  if (run.throttled_s > kThrottledShareS)
    reasons.push_back(fmt::format("a quota took {:.1f} s from it", run.throttled_s));
  return fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace glintmark
