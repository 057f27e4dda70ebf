// glintmark bench zk16: Table 1 of [ZK16] over scenes and views.
#pragma once
#include <string>
#include <vector>

#include "host/cli/command_line.h"

namespace glintmark {

struct BenchOptions {
  std::vector<std::string> scenes, views;  // empty: all
  std::string size = "1920x1080", method = "zk16";
  int reps = 9;
  std::string folder = "results/latest";
  std::string json, csv;  // further copies, empty for none
  bool resume = false;
};

/// Measures, prints Table 1 and the breakdown, and writes records.jsonl (while running),
/// results.json, results.csv, table.txt and a heatmap per view. Returns kExitCheckFailed if some
/// record is not valid. After Ctrl-C throws Interrupted; records.jsonl stays.
int runZk16Bench(const CommandLine& line, const BenchOptions& options);

}  // namespace glintmark
