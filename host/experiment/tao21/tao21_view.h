// One view of table "tao21": all methods timed in turn, and each held against the ground truth.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/image.h"
#include "host/experiment/bench_run.h"
#include "host/report/record/case_name.h"

namespace glintmark {

struct Tao21Settings {
  ShadingOptions shading;  // for the times
  ShadingOptions errors;   // for the errors, smaller
  int truth_spp = 1024;    // the paper's
};

/// Settings of a bench run: errors are taken at a width of at most kTruthWidth_px.
Tao21Settings tao21Settings(const BenchRun& run);
inline constexpr int kTruthWidth_px = 320;

/// The metrics of every case of a view.
const std::vector<std::string>& tao21Metrics();

/// Records by method ("original", "tao21", "exact", "mixture"), and a strip of their pictures
/// beside the truth.
struct Tao21View {
  std::map<std::string, std::vector<Record>> records;
  Image picture;
};

/// The case of a method in a view, which is named by scene, view and perhaps a knob.
CaseName tao21Case(const CaseName& view, std::string_view method);

/// Measures a view of `scene`, whose cases are those of `name`.
Tao21View measureTao21View(BenchRun& run, const Scene& scene, const View& view,
                           const CaseName& name);

}  // namespace glintmark
