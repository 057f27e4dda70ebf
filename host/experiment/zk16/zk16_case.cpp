#include "host/experiment/zk16/zk16_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiment/frame_timing.h"
#include "host/experiment/paper_gpu.h"
#include "host/experiment/zk16/zk16_table.h"
#include "host/ocl/static_counts.h"
#include "host/report/metrics.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr int kZk16OneLaneReps = 3;  // one lane is about ten times as slow
// The counting build does the same arithmetic; other lane counts may round a little differently
// where the compiler reorders nothing but the device's maths functions differ.
constexpr double kSameImageRelMse = 1e-9;

Samples scaled(const Samples& samples, double factor) {
  Samples result = samples;
  for (double& sample : result) sample *= factor;
  return result;
}

struct FrameSamples {
  Samples with_ns, without_ns, difference_ns, event_ns;
};

// Adds frames with glints and without, in turn.
void measureShading(FrameRenderer& glint, FrameRenderer& smooth, const Repetitions& reps,
                    FrameSamples& samples) {
  while (reps.wantsMore({&samples.with_ns, &samples.without_ns})) {
    stopIfInterrupted();
    const FrameTimes with = glint.shade();
    const FrameTimes without = smooth.shade();
    samples.with_ns.push_back(with.shading_wall_ns);
    samples.without_ns.push_back(without.shading_wall_ns);
    samples.difference_ns.push_back(with.shading_wall_ns - without.shading_wall_ns);
    samples.event_ns.push_back(with.shading_event_ns);
  }
}

struct PrepareSamples {
  Samples raster_ns, upload_ns, readback_ns;
};

PrepareSamples measurePrepare(FrameRenderer& renderer, const Repetitions& reps) {
  PrepareSamples samples;
  while (reps.wantsMore({&samples.raster_ns})) {
    stopIfInterrupted();
    FrameTimes times = renderer.prepare();
    samples.raster_ns.push_back(times.raster_ns);
    samples.upload_ns.push_back(times.upload_ns);
    renderer.shade();  // what no launch has written is an error of the driver
    renderer.readRadiance(&times);
    samples.readback_ns.push_back(times.readback_ns);
  }
  return samples;
}

// One view's renderers and what has been learned about them.
class CaseMeasurement {
 public:
  CaseMeasurement(BenchRun& run, const Scene& scene, const View& view)
      : run_(run),
        scene_(scene),
        view_(view),
        name_(CaseName{{scene.name, view.name}}.text()),
        shading_(run.shading()) {
    shading_.method = run.method();
  }

  Zk16Case run();

 private:
  std::unique_ptr<FrameRenderer> frame(const ShadingOptions& options) const {
    return preparedFrame(run_, scene_, view_, options);
  }
  void checkImages(const Image& glint, const Image& smooth);
  void checkSame(const Image& image, const Image& reference, const char* what);
  Samples measureSpeedup(FrameRenderer& glint, const Image& reference);
  void addShading(const FrameSamples& frames, double peak_gflops);
  void addFacts(const FrameRenderer& glint, const PrepareSamples& prepare);
  void addStaticCounts(const FrameRenderer& glint);
  void add(const std::string& metric, const Samples& samples, const std::string& note = "",
           std::optional<double> paper = std::nullopt);
  std::optional<double> paperMs() const;

  BenchRun& run_;
  const Scene& scene_;
  const View& view_;
  std::string name_;
  ShadingOptions shading_;
  std::string kernels_;
  Zk16Case result_;
};

void CaseMeasurement::add(const std::string& metric, const Samples& samples,
                          const std::string& note, std::optional<double> paper) {
  Record record = run_.record(zk16Spec(), name_, metric, samples, note);
  record.config["kernels"] = kernels_;
  record.paper = paper;
  result_.records.push_back(std::move(record));
}

// The paper's figures are for 1920x1080 only.
std::optional<double> CaseMeasurement::paperMs() const {
  const bool full_size = shading_.width_px == 1920 && shading_.height_px == 1080;
  return full_size ? zk16PaperMs(scene_.name, view_.name) : std::nullopt;
}

// Does nothing if the reference itself is bad, which checkImages has reported.
void CaseMeasurement::checkSame(const Image& image, const Image& reference, const char* what) {
  if (badValueCount(reference) > 0) return;
  if (badValueCount(image) > 0) {
    result_.failures.push_back(fmt::format("{} gives bad radiance values", what));
  } else if (const double difference = relMse(image, reference); difference > kSameImageRelMse) {
    result_.failures.push_back(
        fmt::format("{} gives another image (relMSE {:.2g})", what, difference));
  }
}

void CaseMeasurement::checkImages(const Image& glint, const Image& smooth) {
  for (const Image* image : {&glint, &smooth})
    if (const std::string fault = radianceFault(*image); !fault.empty()) {
      result_.failures.push_back(fault);
      return;
    }
  const double bias = relativeBias(glint, smooth);
  if (!(std::abs(bias) <= kZk16MeanBound)) {
    result_.failures.push_back(
        fmt::format("mean radiance is {:+.1f}% off the smooth lobes'", 100 * bias));
  }
}

// The same kernel with one lane and with all, in turn; by event times.
Samples CaseMeasurement::measureSpeedup(FrameRenderer& glint, const Image& reference) {
  ShadingOptions one_lane = shading_;
  one_lane.lanes = 1;
  const auto narrow = frame(one_lane);
  checkSame(narrow->readRadiance(), reference, "W = 1");
  return shadeInTurn(*narrow, glint, run_.reps().atMost(kZk16OneLaneReps)).ratios();
}

void CaseMeasurement::addStaticCounts(const FrameRenderer& glint) {
  const auto config = std::ranges::find_if(glint.configs(), &KernelConfig::glint);
  if (config == glint.configs().end()) return;
  const std::optional<StaticCounts> counts =
      staticCounts(run_.cache().get("shade.cl", *config), "shade");
  if (!counts) return;
  const std::string note =
      fmt::format("machine instructions of the compiled kernel, {} lanes each", config->width);
  add("kernel_instructions", {static_cast<double>(counts->kernel_instructions)}, note,
      kZk16ShaderInstructions);
  add("cell_loop_instructions", {static_cast<double>(counts->cell_loop_instructions)}, note,
      kZk16LoopInstructions);
}

void CaseMeasurement::addShading(const FrameSamples& frames, double peak_gflops) {
  const CellCounts& counts = result_.counted.counts;
  const double cells = counts.mean * static_cast<double>(counts.glint_px);
  add("shading_ms", scaled(frames.difference_ns, kMsPerNs),
      "frame with glints minus frame without, in turn", paperMs());
  add("shading_event_ms", scaled(frames.event_ns, kMsPerNs), "kernel events, with glints");
  add("frame_with_ms", scaled(frames.with_ns, kMsPerNs), "enqueue to finish");
  add("frame_without_ms", scaled(frames.without_ns, kMsPerNs), "enqueue to finish");
  add("ns_per_cell", scaled(frames.difference_ns, cells > 0 ? 1 / cells : 0));
  const double paid = counts.paid_mean * static_cast<double>(counts.glint_px);
  add("ns_per_paid_cell", scaled(frames.difference_ns, paid > 0 ? 1 / paid : 0),
      "of cells that lanes work through side by side");
  if (const std::optional<double> paper_ms = paperMs()) {
    add("normalised_cost",
        scaled(frames.difference_ns,
               kMsPerNs * normalisedCost(1, peak_gflops, *paper_ms, kGtx980PeakGflops)),
        "shading_ms x our peak / (paper's ms x 4980 GFLOP/s)");
  }
}

// What is counted or timed outside the frames.
void CaseMeasurement::addFacts(const FrameRenderer& glint, const PrepareSamples& prepare) {
  const CellCounts& counts = result_.counted.counts;
  const double pixels = static_cast<double>(shading_.width_px) * shading_.height_px;
  add("cells_min", {static_cast<double>(counts.min)});
  add("cells_mean", {counts.mean});
  add("cells_paid_mean", {counts.paid_mean}, "idle lanes and steps rounded up included");
  add("cells_max", {static_cast<double>(counts.max)});
  add("guard_hits", {static_cast<double>(counts.guard_hits)});
  add("raster_ms", scaled(prepare.raster_ns, kMsPerNs));
  add("upload_ms", scaled(prepare.upload_ns, kMsPerNs));
  add("readback_ms", scaled(prepare.readback_ns, kMsPerNs));
  add("build_ms", {glint.buildNs() * kMsPerNs});
  add("first_enqueue_ms", {glint.firstEnqueueNs() * kMsPerNs});
  add("triangles", {static_cast<double>(scene_.mesh.triangleCount())});
  add("covered_px", {static_cast<double>(glint.planes().covered_px)});
  double glint_px = 0;
  for (const PixelList& list : glint.planes().lists)
    if (scene_.materials[list.material].has_glints) glint_px += list.count;
  add("glint_share", {glint_px / pixels});
  add("buffer_bytes_per_px", {static_cast<double>(glint.bufferBytes()) / pixels});
}

Zk16Case CaseMeasurement::run() {
  ShadingOptions smooth_options = shading_;
  smooth_options.glints = false;
  const auto glint_frame = frame(shading_), smooth_frame = frame(smooth_options);
  FrameRenderer &glint = *glint_frame, &smooth = *smooth_frame;

  const Image radiance = glint.readRadiance();
  checkImages(radiance, smooth.readRadiance());
  ShadingOptions counting = shading_;
  counting.count_cells = true;
  {
    const auto counter = frame(counting);
    checkSame(counter->readRadiance(), radiance, "the counting build");
    result_.counted = {counter->readCells(), counter->cellCounts()};
  }
  stopIfInterrupted();
  kernels_ = kernelOptions(glint);

  // The peak in the middle of the frames, since the machine's speed may drift.
  FrameSamples frames;
  const Repetitions reps = run_.reps();
  measureShading(glint, smooth, reps.scaled(0.5).atMost((run_.options().reps + 1) / 2), frames);
  const DevicePeaks peaks = measurePeaks(run_.device(), run_.cache(), shading_.lanes);
  measureShading(glint, smooth, reps, frames);
  const PrepareSamples prepare = measurePrepare(glint, run_.reps().atMost(run_.options().reps));

  addShading(frames, peaks.gflops);
  if (shading_.lanes > 1) {
    add("speedup_vs_w1", measureSpeedup(glint, radiance),
        fmt::format("kernel events at {}x{}, in turn", shading_.width_px, shading_.height_px));
  } else {
    add("speedup_vs_w1", {1}, "the device runs one lane");
  }
  addFacts(glint, prepare);
  add("peak_gflops", {peaks.gflops}, "in the middle of the frames");
  add("peak_gbs", {peaks.gbs}, "in the middle of the frames");
  addStaticCounts(glint);

  for (Record& record : result_.records) {
    record.valid = result_.failures.empty();
    if (!record.valid)
      record.note = fmt::format("not valid: {}", fmt::join(result_.failures, "; "));
  }
  return std::move(result_);
}

}  // namespace

const std::vector<std::string>& zk16Metrics() {
  static const std::vector<std::string> metrics = {
      "shading_ms",          "shading_event_ms", "frame_with_ms", "frame_without_ms",
      "ns_per_cell",         "ns_per_paid_cell", "speedup_vs_w1", "cells_min",
      "cells_mean",          "cells_paid_mean",  "cells_max",     "guard_hits",
      "raster_ms",           "upload_ms",        "readback_ms",   "build_ms",
      "first_enqueue_ms",    "triangles",        "covered_px",    "glint_share",
      "buffer_bytes_per_px", "peak_gflops",      "peak_gbs"};
  return metrics;
}

Zk16Case measureZk16Case(BenchRun& run, const Scene& scene, const View& view) {
  return CaseMeasurement(run, scene, view).run();
}

}  // namespace glintmark
