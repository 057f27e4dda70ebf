// glintmark bench msbrdf: [PAT18]'s simulation, the models fitted to it, and what they cost.
#pragma once
#include "host/experiment/bench_run.h"

namespace glintmark {

BenchTable msbrdfBench();

}  // namespace glintmark
