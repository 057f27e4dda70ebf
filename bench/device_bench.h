// What the benchmark programs of kernels share: the device, its facts in the output, timing by the
// device's own clock.
#pragma once
#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

#include "host/harness/kernel_bench.h"

namespace glintmark::bench {

/// The device that runDeviceBenchmarks() opened, with its programs.
KernelBench& deviceBench();

/// Lane counts to measure: one, and the chosen one where it is wider.
std::vector<int> laneCounts();

/// Runs `work` once per iteration and counts the time of the launches of kernel `kernel` in it by
/// their events; needs UseManualTime(). What else `work` does, uploads say, is not counted.
/// `items` is the number of `unit` per launch: counters "<unit>/s" and "ns/<unit>".
void timeKernel(benchmark::State& state, const std::string& kernel, double items,
                const std::string& unit, const std::function<void()>& work);

/// Registers "<name>/lanes:<W>" for each of laneCounts(), timed by the device.
void registerLanes(const std::string& name,
                   const std::function<void(benchmark::State&, int lanes)>& run);

/// main() of a program. Takes --device I|NAME and --width W beside Google Benchmark's options, puts
/// the run's facts into the context of its output, opens deviceBench() and runs what `registerAll`
/// registers. Exit code 0, 2 for bad usage or an error, 3 for no device.
int runDeviceBenchmarks(int argc, char** argv, void (*registerAll)());
/// The same for code of the host: no device is opened.
int runHostBenchmarks(int argc, char** argv, void (*registerAll)());

}  // namespace glintmark::bench
