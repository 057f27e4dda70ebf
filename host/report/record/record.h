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
};

struct RunInfo {
  std::string date, git, command, cpu, device, driver, platform;
  std::string inputs{};  // hash of the kernels, tables, scenes and meshes; empty: not taken
  int cores = 0;
  int width = 0;  // lanes
  double peak_gflops = 0, peak_gbs = 0;
};

}  // namespace glintmark
