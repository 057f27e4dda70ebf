// Table `effects`: what each effect, each pair and all of them cost, and what not having the others
// saves.
#pragma once
#include "host/experiment/bench_run.h"

namespace glintmark {

BenchTable effectsBench();

}  // namespace glintmark
