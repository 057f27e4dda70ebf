// glintmark bench: the papers' timing tables.
#pragma once
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"

namespace glintmark {

/// Tables that runBench measures, in the order in which it does and prints them.
std::vector<std::string> benchTableNames();

/// Measures the tables of these names, all if there are none, that have the options' scenes and
/// views; writes the run's folder, prints the tables and returns the exit code. Throws Error for
/// names that are not known, listing the known ones.
int runBench(const Session& session, const std::vector<std::string>& names,
             const BenchOptions& options);

}  // namespace glintmark
