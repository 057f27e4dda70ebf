#include "bench/device_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "host/core/error.h"
#include "host/core/trace.h"
#include "host/experiment/session.h"
#include "host/report/record/run_info.h"

namespace glintmark::bench {
namespace {

int chosen_lanes = 1;
// Lives as long as the program: drivers dislike late teardown.
KernelBench* opened_bench = nullptr;

// Takes `--name value` out of the arguments; nothing if it is not there.
std::string takeOption(int& argc, char** argv, const char* name) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) != 0) continue;
    const std::string value = argv[i + 1];
    std::copy(argv + i + 2, argv + argc + 1, argv + i);  // the null at the end as well
    argc -= 2;
    return value;
  }
  return "";
}

CommonOptions takeCommonOptions(int& argc, char** argv) {
  CommonOptions common;
  common.device = takeOption(argc, argv, "--device");
  const std::string width = takeOption(argc, argv, "--width");
  if (!width.empty()) {
    common.lanes = std::atoi(width.c_str());
    if (common.lanes == 0) throw Error("--width " + width + " is not a lane count");
  }
  return common;
}

void addContext(const RunInfo& run) {
  benchmark::AddCustomContext("git", run.git);
  benchmark::AddCustomContext("command", run.command);
  benchmark::AddCustomContext("cpu", run.cpu);
  if (run.device.empty()) return;
  benchmark::AddCustomContext("device", run.device);
  benchmark::AddCustomContext("driver", run.driver);
  benchmark::AddCustomContext("platform", run.platform);
  benchmark::AddCustomContext("width", std::to_string(run.width));
}

int runAll(int argc, char** argv, void (*registerAll)(), bool on_device) {
  try {
    Session session;
    session.words.assign(argv, argv + argc);
    session.common = takeCommonOptions(argc, argv);
    if (on_device) {
      opened_bench = new KernelBench(openDevice(session.common));
      const Device& device = opened_bench->device;
      chosen_lanes = chosenLanes(session.common, device);
      addContext(describeRun(session, device));
    } else {
      addContext(describeHost(session.words));
    }
    registerAll();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return kExitBadInput;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return kExitDone;
  } catch (const DeviceError& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return kExitNoDevice;
  } catch (const Error& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return kExitBadInput;
  }
}

double kernelNs(const std::string& kernel) {
  double sum_ns = 0;
  for (const DeviceInterval& i : deviceIntervals())
    if (i.category == "kernel" && i.name == kernel)
      sum_ns += static_cast<double>(i.end_ns - i.begin_ns);
  return sum_ns;
}

}  // namespace

KernelBench& deviceBench() {
  return *opened_bench;
}

std::vector<int> laneCounts() {
  return chosen_lanes > 1 ? std::vector{1, chosen_lanes} : std::vector{1};
}

void timeKernel(benchmark::State& state, const std::string& kernel, double items,
                const std::string& unit, const std::function<void()>& work) {
  work();  // compiled, and in the caches
  double all_ns = 0;
  for (auto _ : state) {
    startTrace();
    work();
    stopTrace();
    const double ns = kernelNs(kernel);
    state.SetIterationTime(ns * 1e-9);
    all_ns += ns;
  }
  if (all_ns == 0) state.SkipWithError(("no launch of " + kernel).c_str());
  const double all_items = items * static_cast<double>(state.iterations());
  state.counters[unit + "/s"] = all_items / (all_ns * 1e-9);
  state.counters["ns/" + unit] = all_ns / all_items;
}

void registerLanes(const std::string& name,
                   const std::function<void(benchmark::State&, int lanes)>& run) {
  for (const int lanes : laneCounts())
    benchmark::RegisterBenchmark(fmt::format("{}/lanes:{}", name, lanes).c_str(),
                                 [run, lanes](benchmark::State& state) { run(state, lanes); })
        ->Unit(benchmark::kMicrosecond)
        ->UseManualTime();
}

int runDeviceBenchmarks(int argc, char** argv, void (*registerAll)()) {
  return runAll(argc, argv, registerAll, true);
}

int runHostBenchmarks(int argc, char** argv, void (*registerAll)()) {
  return runAll(argc, argv, registerAll, false);
}

}  // namespace glintmark::bench
