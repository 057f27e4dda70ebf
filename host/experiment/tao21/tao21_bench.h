// Table "tao21": area lights on normal-mapped surfaces.
#pragma once
#include "host/experiment/bench_run.h"

namespace glintmark {

BenchTable tao21Bench();

}  // namespace glintmark
