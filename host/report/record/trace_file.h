// A run's intervals as a file for chrome://tracing or ui.perfetto.dev.
#pragma once
#include <filesystem>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// What was traced so far, in the Trace Event Format (JSON): complete events ("ph": "X") with times
/// in microseconds since startTrace(), process 1 for the host's threads, process 2 for the device's
/// queue. results/README.md describes it.
std::string traceJson(const RunInfo& run);

/// Stops tracing and writes traceJson(), whole or not at all. Throws Error like writeFile().
void writeTrace(const std::filesystem::path& file, const RunInfo& run);

}  // namespace glintmark
