// One measured figure. results/README.md describes the schema.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/core/statistics.h"

namespace glintmark {

struct Record {
  std::string table;   // "zk16"
  std::string case_;   // "snow/steep"; key "case" in JSON
  std::string metric;  // "shading_ms"
  std::string unit;    // "ms"
  Summary value;       // n, min, median, p95, stddev
  std::optional<double> paper;
  bool valid = true;  // checked against the reference in the same run
  std::string note;
  std::map<std::string, std::string> config;
  std::string timer;  // clock of the kernels: "device" or "wall"; empty in older files
};

/// The machine at one moment; 0 where it is not known.
struct MachineState {
  double load = 0, clock_mhz = 0;  // of the last minute; mean of the processors
  double peak_gflops = 0, peak_gbs = 0;
};

struct RunInfo {
  std::string date, git, command, cpu, device, driver, platform;
  std::string inputs{};  // hash of the kernels, tables, scenes and meshes; empty: not taken
  int cores = 0;         // that the process may use
  int width = 0;         // lanes
  double peak_gflops = 0, peak_gbs = 0;
  // Empty or 0 in older files, and at the end in logs.
  unsigned long long memory_bytes = 0;  // that the process could take at the start
  MachineState begin{}, end{};
  double others_cores = 0;  // processors that others kept busy, on average
  double throttled_s = 0;   // taken by a quota
  std::string busy{};       // why its times are those of a busy machine; empty if they are not
};

}  // namespace glintmark
