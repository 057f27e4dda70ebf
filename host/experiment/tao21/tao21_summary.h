// The figures of table "tao21" that are not about one view.
#pragma once
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"

namespace glintmark {

/// Case "all".
const std::vector<std::string>& tao21SummaryMetrics();
std::vector<Record> measureTao21Summary(BenchRun& run);

/// Cases "area_plane/lights=N", "area_plane/vertices=N" and "area_plane/shape=S": shading_ms.
std::vector<std::string> tao21CurveCases();
std::vector<Record> measureTao21Curve(BenchRun& run, const std::string& case_name);

}  // namespace glintmark
