// Records and text of one kind of pixels: what makes an error of glints.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "host/experiment/accuracy/glint_judge.h"
#include "host/experiment/bench_run.h"

namespace glintmark {

/// All of a stage's figures. Those that were measured by replicate are recorded by replicate, so
/// that their spread over the root of their number is the standard error.
std::vector<Record> glintStageRecords(const BenchRun& run, const std::string& case_name,
                                      const std::string& role, const GlintFigures& figures);

/// Two tables, at most kTableColumnsLimit columns: the figures of each method and form of the truth
/// by lambda and by aspect, and how much they move over a zoom. Empty if there are no such records.
std::string glintStageText(std::span<const Record> records);

}  // namespace glintmark
