// glintmark accuracy: what each knob's accuracy costs in time.
#pragma once
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"

namespace glintmark {

/// Names of the effects, in the order in which they are measured and printed.
std::vector<std::string> accuracyEffects();

/// What was asked for; empty lists stand for all.
struct AccuracySelection {
  std::vector<std::string> effects, knobs;
};

/// Measures the selected settings, writes the run's folder and prints the table; returns the exit
/// code. Throws Error for names that are not known, listing the known ones.
int runAccuracy(const Session& session, const AccuracySelection& selection, BenchOptions options);

}  // namespace glintmark
