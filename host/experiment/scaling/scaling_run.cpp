#include "host/experiment/scaling/scaling_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "host/core/error.h"
#include "host/core/unknown_name.h"
#include "host/experiment/all_tables.h"
#include "host/experiment/frame_timing.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/scaling/scaling_table.h"
#include "host/experiment/survival.h"
#include "host/report/metrics.h"
#include "host/report/record/case_name.h"
#include "host/report/record/score.h"

namespace glintmark {
namespace {

constexpr int kHeights_px[] = {360, 720, 1080, 1440, 2160, 4320};

// A device, which must outlive what shades on it, and a frame of it.
struct ScaledFrame {
  std::unique_ptr<Device> part;  // null: the run's device
  std::unique_ptr<FrameRenderer> renderer;
  FrameTimes prepared;
};

class ScalingMeasurement {
 public:
  ScalingMeasurement(BenchRun& run, const ScalingSelection& selection)
      : run_(run),
        scene_(openScene(run.session().common, selection.scene)),
        view_(chosenView(scene_, selection.view)),
        most_height_px_(selection.most_height_px) {}

  /// The values of a knob that this device and its memory can do; what they cannot goes to
  /// leftOut().
  std::vector<int> values(const std::string& knob);
  std::string caseName(const std::string& knob, int value) const {
    return CaseName{{scene_.name, view_.name}, {{knob, value}}}.text();
  }
  std::vector<Record> measure(const std::string& case_name);
  std::string viewName() const { return CaseName{{scene_.name, view_.name}}.text(); }
  const std::string& leftOut() const { return left_out_; }

 private:
  std::vector<int> heights();
  std::vector<int> threadCounts();
  ShadingOptions options(const std::string& knob, int value) const;
  ScaledFrame frame(const std::string& knob, int value);
  void leaveOut(const std::string& what, const Error& why) {
    left_out_ += fmt::format("{} left out: {}\n", what, why.what());
  }

  BenchRun& run_;
  Scene scene_;
  const View& view_;
  int most_height_px_;
  std::string left_out_;
};

ImageSize sizeOfHeight(int height_px) {
  return {height_px * 16 / 9, height_px};
}

std::vector<int> ScalingMeasurement::heights() {
  std::vector<int> heights_px;
  for (const int height_px : kHeights_px) {
    if (height_px > most_height_px_) continue;
    const ImageSize size = sizeOfHeight(height_px);
    try {
      parseSize(fmt::format("{}x{}", size.width_px, size.height_px));
      heights_px.push_back(height_px);
    } catch (const Error& error) {
      leaveOut(fmt::format("{}={}", kHeightKnob, height_px), error);
    }
  }
  return heights_px;
}

// Powers of two and all.
std::vector<int> ScalingMeasurement::threadCounts() {
  const int all = static_cast<int>(run_.device().info().compute_units);
  std::vector<int> counts;
  for (int count = 1; count < all; count *= 2) counts.push_back(count);
  counts.push_back(all);
  try {
    run_.device().part(1);
  } catch (const Error& error) {
    leaveOut(kThreadsKnob, error);
    counts.clear();
  }
  return counts;
}

std::vector<int> ScalingMeasurement::values(const std::string& knob) {
  if (knob == kHeightKnob) return heights();
  if (knob == kThreadsKnob) return threadCounts();
  return {kLaneCounts.begin(), kLaneCounts.end()};
}

ShadingOptions ScalingMeasurement::options(const std::string& knob, int value) const {
  ShadingOptions options = run_.shading();
  options.method = run_.method();
  if (knob == kHeightKnob) {
    const ImageSize size = sizeOfHeight(value);
    options.width_px = size.width_px;
    options.height_px = size.height_px;
  }
  if (knob == kLanesKnob) options.lanes = value;
  return options;
}

ScaledFrame ScalingMeasurement::frame(const std::string& knob, int value) {
  stopIfInterrupted();
  const bool divided = knob == kThreadsKnob;
  ScaledFrame frame;
  if (divided)
    frame.part = std::make_unique<Device>(run_.device().part(static_cast<unsigned>(value)));
  frame.renderer =
      std::make_unique<FrameRenderer>(frame.part ? *frame.part : run_.device(), scene_, view_,
                                      options(knob, value), divided ? value : run_.threads());
  frame.prepared = frame.renderer->prepare();
  for (int warm = 0; warm < run_.options().warmup; ++warm) frame.renderer->shade();
  return frame;
}

std::vector<Record> ScalingMeasurement::measure(const std::string& case_name) {
  const CaseName parts = CaseName::parse(case_name);
  const std::string& knob = parts.knobs.back().name;
  const int value = static_cast<int>(parts.number(knob));
  const ScaledFrame scaled = frame(knob, value);
  const Image radiance = scaled.renderer->readRadiance();
  const auto covered_px = static_cast<double>(coveredPixels(radiance).width);
  std::vector<Record> records;
  const auto add = [&](const char* metric, const Samples& samples, const std::string& note = "") {
    records.push_back(run_.record(scalingSpec(), case_name, metric, samples, note));
    records.back().config["kernels"] = kernelOptions(*scaled.renderer);
  };
  Samples times_ms, ratios;
  if (knob == kHeightKnob) {
    times_ms = shadeTimesMs(*scaled.renderer, run_.reps());
  } else {
    const ScaledFrame one = frame(knob, 1);
    const TurnTimes turn = shadeInTurn(*one.renderer, *scaled.renderer, run_.reps());
    times_ms = turn.second_ms;
    ratios = turn.ratios();
  }
  Samples per_px;
  for (const double time_ms : times_ms) per_px.push_back(time_ms / kMsPerNs / covered_px);
  add("shading_ms", times_ms);
  add("ns_per_px", per_px);
  add("prepare_ms", {(scaled.prepared.raster_ns + scaled.prepared.upload_ns) * kMsPerNs});
  add("buffer_bytes_per_px", {static_cast<double>(scaled.renderer->bufferBytes()) /
                              (static_cast<double>(radiance.width) * radiance.height)});
  if (!ratios.empty()) add("speedup", ratios, "in turn with one");
  if (knob == kThreadsKnob) {
    for (double& ratio : ratios) ratio /= value;
    add("efficiency", ratios);
  }
  invalidateIfFaulty(records, radiance);
  return records;
}

void requireKnownScalingKnobs(const std::vector<std::string>& names) {
  const std::vector<std::string> known = scalingKnobs();
  for (const std::string& name : names) requireKnownName("axis", name, known, "axes");
}

}  // namespace

std::vector<std::string> scalingKnobs() {
  return {kHeightKnob, kLanesKnob, kThreadsKnob};
}

namespace {

int measureScaling(const Session& session, const ScalingSelection& selection,
                   const BenchOptions& options) {
  const InterruptGuard guard;
  BenchRun run(session, options);
  ScalingMeasurement measurement(run, selection);
  std::vector<std::string> cases;
  for (const std::string& knob : selectNames(scalingKnobs(), selection.knobs))
    for (const int value : measurement.values(knob))
      cases.push_back(measurement.caseName(knob, value));
  if (cases.empty()) throw Error("nothing can be measured here: " + measurement.leftOut());
  run.measureCases(scalingSpec().name, cases,
                   {"shading_ms", "ns_per_px", "prepare_ms", "buffer_bytes_per_px"},
                   [&](const std::string& name) { return measurement.measure(name); });
  const std::vector<Record> records = run.recordsOf(scalingSpec().name);
  requireMeasured(records.size());
  const std::string head = fmt::format(
      "Scaling of {}, {} lanes; pictures of 16:9 by height, lanes and threads at {}\non {:.90}\n\n",
      measurement.viewName(), run.info().width, run.options().size, run.info().device);
  return run.finish(head + scalingTableText(records) + measurement.leftOut() +
                    invalidText(records) + "\n" + scoreLine(scalingSpec(), records));
}

}  // namespace

int runScaling(const Session& session, const ScalingSelection& selection, BenchOptions options) {
  requireKnownScalingKnobs(selection.knobs);
  if (selection.most_height_px < kHeights_px[0] || selection.most_height_px > 16384)
    throw Error(fmt::format("--up-to {} is not a height from {} to 16384 pixels",
                            selection.most_height_px, kHeights_px[0]));
  return runSurviving(session.common.quiet, [&](bool first) {
    options.resume = options.resume || !first;
    return measureScaling(session, selection, options);
  });
}

// `bench` does not measure it.
BenchTable scalingBench() {
  return {.spec = scalingSpec()};
}

}  // namespace glintmark
