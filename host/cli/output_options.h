// Options of every command that writes a folder of results.
#pragma once
#include "host/experiment/bench_run.h"

namespace CLI {
class App;
}

namespace glintmark {

/// -o, --json, --csv and --resume; the folder already in `options` is the default.
void addOutputOptions(CLI::App& command, BenchOptions& options);

}  // namespace glintmark
