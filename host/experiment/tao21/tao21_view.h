// One view of table "tao21": all methods timed in turn, and each held against the ground truth.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/experiment/bench_run.h"
#include "host/frame/frame_renderer.h"

namespace glintmark {

struct Tao21Settings {
  ShadingOptions shading;  // for the times
  ImageSize truth_size;    // for the errors
  int truth_spp = 1024;    // the paper's
  int reps = 9;
  int threads = 0;
};

/// Settings of a bench run: errors are taken at a width of at most kTruthWidth_px.
Tao21Settings tao21Settings(const BenchRun& run);
inline constexpr int kTruthWidth_px = 320;

/// The metrics of every case of a view.
const std::vector<std::string>& tao21Metrics();

/// Records by method ("original", "tao21", "exact"), and a strip of their pictures beside the
/// truth.
struct Tao21View {
  std::map<std::string, std::vector<Record>> records;
  Image picture;
};

/// Measures scene/view; the case of a method is scene/view/method, and then `suffix`.
Tao21View measureTao21View(BenchRun& run, const Scene& scene, const View& view,
                           const Tao21Settings& settings, const std::string& suffix);

/// A record of this table with the run's key; `samples` not empty.
Record tao21Record(const BenchRun& run, const std::string& case_name, const std::string& metric,
                   const std::string& unit, const std::vector<double>& samples,
                   const std::string& note = "");

/// The pixels that `image` covers (alpha 1), in one row of RGB.
Image coveredPixels(const Image& image);

/// No value is negative or not finite.
bool isSane(const Image& image);

/// Shades once; kernel event time [ms]. Throws Interrupted after Ctrl-C.
double shadeMs(FrameRenderer& renderer);

}  // namespace glintmark
