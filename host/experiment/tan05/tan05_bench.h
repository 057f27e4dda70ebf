// glintmark bench tan05: the comparisons of [TAN05] over scenes, views, distances and methods.
#pragma once
#include "host/experiment/bench_run.h"

namespace glintmark {

/// Also writes a strip of pictures per view into the run's folder.
BenchTable tan05Bench();

}  // namespace glintmark
