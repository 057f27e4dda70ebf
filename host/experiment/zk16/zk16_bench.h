// glintmark bench zk16: Table 1 of [ZK16] over scenes and views.
#pragma once
#include "host/experiment/bench_run.h"

namespace glintmark {

/// Table 1 and its breakdown; also writes a heatmap of cells per view into the run's folder.
BenchTable zk16Bench();

}  // namespace glintmark
