// Measures one view of [ZK16] Table 1.
#pragma once
#include <string>
#include <vector>

#include "host/experiment/bench_run.h"
#include "host/experiment/count_cells.h"

namespace glintmark {

struct Zk16Case {
  std::vector<Record> records;  // table "zk16", case "scene/view"
  CountedCells counted;
  std::vector<std::string> failures;  // why records are not valid, one clause each
};

/// Metrics that every case has, in the order of its records.
const std::vector<std::string>& zk16Metrics();

/// Measures one view. The records' configurations have the kernels' build options too. Shading time
/// is the median over repetitions of the frame with glints minus the frame without, measured
/// in turn. Records are valid only if, in the same run, the radiance is finite and not negative,
/// the counting build and W = 1 give the same image, and the mean radiance is that of smooth lobes
/// within kZk16MeanBound. Throws Interrupted after Ctrl-C.
Zk16Case measureZk16Case(BenchRun& run, const Scene& scene, const View& view);

/// Glints scatter the light of the smooth lobe over pixels; the mean over a frame keeps it but for
/// the sampling noise of few bright pixels.
inline constexpr double kZk16MeanBound = 0.1;

}  // namespace glintmark
