// glintmark scale: how the time of a view grows with pixels, lanes and compute units.
#pragma once
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"

namespace glintmark {

/// What is turned: "height", "lanes", "threads".
std::vector<std::string> scalingKnobs();

/// What was asked for.
struct ScalingSelection {
  std::string scene, view;         // view: empty for the scene's first
  std::vector<std::string> knobs;  // empty: all
  int most_height_px = 4320;
};

/// Measures heights from 360 pixels to 8K at 16:9, every width of work-items, and parts of the
/// device by powers of two; writes the run's folder, prints the table and returns the exit code.
/// What the device or its memory cannot do is left out, and said so. Throws Error for names that
/// are not known, listing the known ones, or if nothing is left.
int runScaling(const Session& session, const ScalingSelection& selection, BenchOptions options);

}  // namespace glintmark
