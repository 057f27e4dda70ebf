// Measures one view of [ZK16] Table 1.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "host/experiment/count_cells.h"
#include "host/frame/frame_renderer.h"
#include "host/ocl/compute.h"
#include "host/report/record/record.h"

namespace glintmark {

struct Zk16Settings {
  ShadingOptions shading;  // size, lanes, method
  int reps = 9;            // of everything but W = 1
  int w1_reps = 3;         // one lane is about ten times as slow
  int threads = 0;
};

struct Zk16Case {
  std::vector<Record> records;  // table "zk16", case "scene/view"
  CountedCells counted;
  std::vector<std::string> failures;  // why records are not valid, one clause each
};

/// Metrics that every case has, in the order of its records.
const std::vector<std::string>& zk16Metrics();

/// Measures one view. `config` goes into every record beside the kernels' build options. Shading
/// time is the median over repetitions of the frame with glints minus the frame without, measured
/// in turn. Records are valid only if, in the same run, the radiance is finite and not negative,
/// the counting build and W = 1 give the same image, and the mean radiance is that of smooth lobes
/// within kZk16MeanBound. Throws Interrupted after Ctrl-C.
Zk16Case measureZk16Case(Device& device, ProgramCache& cache, const Scene& scene, const View& view,
                         const Zk16Settings& settings,
                         const std::map<std::string, std::string>& config);

/// Glints scatter the light of the smooth lobe over pixels; the mean over a frame keeps it but for
/// the sampling noise of few bright pixels.
inline constexpr double kZk16MeanBound = 0.1;

}  // namespace glintmark
