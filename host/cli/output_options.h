// Options of every command that writes a folder of results.
#pragma once
#include "host/cli/command.h"
#include "host/experiment/bench_run.h"

namespace glintmark {

/// -o, --json, --csv and --resume; the folder already in `options` is the default.
void addOutputOptions(Command command, BenchOptions& options);

}  // namespace glintmark
