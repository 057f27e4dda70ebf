// What table "tan05" says over all views: ratios of methods, time over lobes and anisotropy, fit.
#pragma once
#include <string>
#include <vector>

#include "host/experiment/tan05/tan05_view.h"

namespace glintmark {

/// Cases "disk/oblique/lobes=N" and "disk/oblique/anisotropy=N".
std::vector<std::string> tan05KnobCases();
const std::vector<std::string>& tan05KnobMetrics();
/// Times of one knob at the size of the command line, its error at 500x500.
std::vector<Record> measureTan05Knob(BenchRun& run, const Tan05Scene& scene,
                                     const std::string& case_name);

const std::vector<std::string>& tan05SummaryMetrics();
/// Case "all": at the size of the command line, view near of the disk.
std::vector<Record> measureTan05Summary(BenchRun& run, const Tan05Scene& scene);

}  // namespace glintmark
