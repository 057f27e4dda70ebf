#include "host/experiment/zk16/zk16_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/core/statistics.h"
#include "host/experiment/bench_run.h"
#include "host/experiment/zk16/zk16_table.h"
#include "host/ocl/static_counts.h"
#include "host/report/metrics.h"

namespace glintmark {
namespace {

constexpr double kMsPerNs = 1e-6;
// The counting build does the same arithmetic; other lane counts may round a little differently
// where the compiler reorders nothing but the device's maths functions differ.
constexpr double kSameImageRelMse = 1e-9;

// Samples of one quantity over the repetitions.
using Samples = std::vector<double>;

Samples scaled(const Samples& samples, double factor) {
  Samples result = samples;
  for (double& sample : result) sample *= factor;
  return result;
}

std::size_t badValueCount(const Image& image) {
  return static_cast<std::size_t>(
      std::ranges::count_if(image.pixels, [](float v) { return !(std::isfinite(v) && v >= 0); }));
}

struct FrameSamples {
  Samples with_ns, without_ns, difference_ns, event_ns;
};

// Adds frames with glints and without, in turn.
void measureShading(FrameRenderer& glint, FrameRenderer& smooth, int reps, FrameSamples& samples) {
  for (int rep = 0; rep < reps; ++rep) {
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

PrepareSamples measurePrepare(FrameRenderer& renderer, int reps) {
  PrepareSamples samples;
  for (int rep = 0; rep < reps; ++rep) {
    stopIfInterrupted();
    FrameTimes times = renderer.prepare();
    samples.raster_ns.push_back(times.raster_ns);
    samples.upload_ns.push_back(times.upload_ns);
    renderer.readRadiance(&times);
    samples.readback_ns.push_back(times.readback_ns);
  }
  return samples;
}

// One view's renderers and what has been learned about them.
class CaseMeasurement {
 public:
  CaseMeasurement(Device& device, ProgramCache& cache, const Scene& scene, const View& view,
                  const Zk16Settings& settings, const std::map<std::string, std::string>& config)
      : device_(device), cache_(cache), scene_(scene), view_(view), settings_(settings) {
    base_.table = "zk16";
    base_.case_ = scene.name + "/" + view.name;
    base_.config = config;
  }

  Zk16Case run();

 private:
  FrameRenderer makeRenderer(const ShadingOptions& options) const {
    return FrameRenderer(device_, scene_, view_, options, settings_.threads);
  }
  void checkImages(const Image& glint, const Image& smooth);
  void checkSame(const Image& image, const Image& reference, const char* what);
  Samples measureSpeedup(FrameRenderer& glint, const Image& reference);
  void addShading(const FrameSamples& frames, double peak_gflops);
  void addFacts(const FrameRenderer& glint, const PrepareSamples& prepare);
  void addStaticCounts(const FrameRenderer& glint);
  void add(const std::string& metric, const std::string& unit, const Samples& samples,
           const std::string& note = "", std::optional<double> paper = std::nullopt);
  std::optional<double> paperMs() const;

  Device& device_;
  ProgramCache& cache_;
  const Scene& scene_;
  const View& view_;
  const Zk16Settings& settings_;
  Record base_;
  Zk16Case result_;
};

void CaseMeasurement::add(const std::string& metric, const std::string& unit,
                          const Samples& samples, const std::string& note,
                          std::optional<double> paper) {
  Record record = base_;
  record.metric = metric;
  record.unit = unit;
  record.value = summarize(samples);
  record.note = note;
  record.paper = paper;
  result_.records.push_back(std::move(record));
}

// The paper's figures are for 1920x1080 only.
std::optional<double> CaseMeasurement::paperMs() const {
  const bool full_size = settings_.shading.width_px == 1920 && settings_.shading.height_px == 1080;
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
  const std::size_t bad_values = badValueCount(glint) + badValueCount(smooth);
  if (bad_values > 0) {
    result_.failures.push_back(
        fmt::format("{} radiance values are negative or not finite", bad_values));
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
  ShadingOptions one_lane = settings_.shading;
  one_lane.lanes = 1;
  FrameRenderer narrow = makeRenderer(one_lane);
  narrow.prepare();
  narrow.shade();
  checkSame(narrow.readRadiance(), reference, "W = 1");
  Samples speedup;
  for (int rep = 0; rep < settings_.w1_reps; ++rep) {
    stopIfInterrupted();
    const double narrow_ns = narrow.shade().shading_event_ns;
    speedup.push_back(narrow_ns / glint.shade().shading_event_ns);
  }
  return speedup;
}

void CaseMeasurement::addStaticCounts(const FrameRenderer& glint) {
  const auto config = std::ranges::find_if(glint.configs(), &KernelConfig::glint);
  if (config == glint.configs().end()) return;
  const std::optional<StaticCounts> counts = staticCounts(cache_.get("shade.cl", *config), "shade");
  if (!counts) return;
  const std::string note =
      fmt::format("machine instructions of the compiled kernel, {} lanes each", config->width);
  add("kernel_instructions", "instructions", {static_cast<double>(counts->kernel_instructions)},
      note, kZk16ShaderInstructions);
  add("cell_loop_instructions", "instructions",
      {static_cast<double>(counts->cell_loop_instructions)}, note, kZk16LoopInstructions);
}

void CaseMeasurement::addShading(const FrameSamples& frames, double peak_gflops) {
  const CellCounts& counts = result_.counted.counts;
  const double cells = counts.mean * static_cast<double>(counts.glint_px);
  add("shading_ms", "ms", scaled(frames.difference_ns, kMsPerNs),
      "frame with glints minus frame without, in turn", paperMs());
  add("shading_event_ms", "ms", scaled(frames.event_ns, kMsPerNs), "kernel events, with glints");
  add("frame_with_ms", "ms", scaled(frames.with_ns, kMsPerNs), "enqueue to finish");
  add("frame_without_ms", "ms", scaled(frames.without_ns, kMsPerNs), "enqueue to finish");
  add("ns_per_cell", "ns", scaled(frames.difference_ns, cells > 0 ? 1 / cells : 0));
  if (const std::optional<double> paper_ms = paperMs()) {
    add("normalised_cost", "1",
        scaled(frames.difference_ns, kMsPerNs * normalisedCost(1, peak_gflops, *paper_ms)),
        "shading_ms x our peak / (paper's ms x 4980 GFLOP/s)");
  }
}

// What is counted or timed outside the frames.
void CaseMeasurement::addFacts(const FrameRenderer& glint, const PrepareSamples& prepare) {
  const CellCounts& counts = result_.counted.counts;
  const double pixels =
      static_cast<double>(settings_.shading.width_px) * settings_.shading.height_px;
  add("cells_min", "cells", {static_cast<double>(counts.min)});
  add("cells_mean", "cells", {counts.mean});
  add("cells_max", "cells", {static_cast<double>(counts.max)});
  add("guard_hits", "pixels", {static_cast<double>(counts.guard_hits)});
  add("raster_ms", "ms", scaled(prepare.raster_ns, kMsPerNs));
  add("upload_ms", "ms", scaled(prepare.upload_ns, kMsPerNs));
  add("readback_ms", "ms", scaled(prepare.readback_ns, kMsPerNs));
  add("build_ms", "ms", {glint.buildNs() * kMsPerNs});
  add("first_enqueue_ms", "ms", {glint.firstEnqueueNs() * kMsPerNs});
  add("triangles", "triangles", {static_cast<double>(scene_.mesh.triangleCount())});
  add("covered_px", "pixels", {static_cast<double>(glint.planes().covered_px)});
  add("buffer_bytes_per_px", "bytes", {static_cast<double>(glint.bufferBytes()) / pixels});
}

Zk16Case CaseMeasurement::run() {
  const ShadingOptions& shading = settings_.shading;
  ShadingOptions smooth_options = shading;
  smooth_options.glints = false;
  FrameRenderer glint = makeRenderer(shading), smooth = makeRenderer(smooth_options);
  glint.prepare();
  smooth.prepare();
  glint.shade();
  smooth.shade();
  stopIfInterrupted();

  const Image radiance = glint.readRadiance();
  checkImages(radiance, smooth.readRadiance());
  ShadingOptions counting = shading;
  counting.count_cells = true;
  {
    FrameRenderer counter = makeRenderer(counting);
    counter.prepare();
    counter.shade();
    checkSame(counter.readRadiance(), radiance, "the counting build");
    result_.counted = {counter.readCells(), counter.cellCounts()};
  }
  stopIfInterrupted();

  std::string options;
  for (const KernelConfig& config : glint.configs()) {
    options += (options.empty() ? "" : " | ") + buildOptions(config);
  }
  base_.config["kernels"] = options;

  // The peak in the middle of the frames, since the machine's speed may drift.
  FrameSamples frames;
  measureShading(glint, smooth, (settings_.reps + 1) / 2, frames);
  const DevicePeaks peaks = measurePeaks(device_, cache_, shading.lanes);
  measureShading(glint, smooth, settings_.reps / 2, frames);
  const PrepareSamples prepare = measurePrepare(glint, settings_.reps);

  addShading(frames, peaks.gflops);
  if (shading.lanes > 1) {
    add("speedup_vs_w1", "1", measureSpeedup(glint, radiance),
        fmt::format("kernel events at {}x{}, in turn", shading.width_px, shading.height_px));
  } else {
    add("speedup_vs_w1", "1", {1}, "the device runs one lane");
  }
  addFacts(glint, prepare);
  add("peak_gflops", "GFLOP/s", {peaks.gflops}, "in the middle of the frames");
  add("peak_gbs", "GB/s", {peaks.gbs}, "in the middle of the frames");
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
      "shading_ms",       "shading_event_ms", "frame_with_ms",
      "frame_without_ms", "ns_per_cell",      "speedup_vs_w1",
      "cells_min",        "cells_mean",       "cells_max",
      "guard_hits",       "raster_ms",        "upload_ms",
      "readback_ms",      "build_ms",         "first_enqueue_ms",
      "triangles",        "covered_px",       "buffer_bytes_per_px",
      "peak_gflops",      "peak_gbs"};
  return metrics;
}

Zk16Case measureZk16Case(Device& device, ProgramCache& cache, const Scene& scene, const View& view,
                         const Zk16Settings& settings,
                         const std::map<std::string, std::string>& config) {
  return CaseMeasurement(device, cache, scene, view, settings, config).run();
}

}  // namespace glintmark
