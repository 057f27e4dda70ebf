#include "host/experiment/effects/effects_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/experiment/effects/effects_table.h"
#include "host/experiment/frame_timing.h"
#include "host/report/metrics.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

// Materials of fewer pixels than this share of the frame are too short to time.
constexpr double kTimedShare = 0.02;
// The mixed frame against the sum of its effects, the bound of the record.
constexpr double kWantedMixedOverSum = 1.1;

Samples ratios(const Samples& above, const Samples& below) {
  Samples result;
  for (std::size_t i = 0; i < above.size(); ++i) result.push_back(above[i] / below[i]);
  return result;
}

// What the effects cost alone, on top of the frame that they share; by repetition.
Samples sumAlone(const Samples& base, const std::vector<const Samples*>& with,
                 const std::vector<const Samples*>& without) {
  Samples sum = base;
  for (std::size_t i = 0; i < sum.size(); ++i)
    for (std::size_t e = 0; e < with.size(); ++e) sum[i] += (*with[e])[i] - (*without[e])[i];
  return sum;
}

}  // namespace

const std::vector<std::string>& effectsMetrics() {
  static const std::vector<std::string> metrics = {"shading_ms",
                                                   "uber_ms",
                                                   "uber_over_specialised",
                                                   "uber_on_lists_over_specialised",
                                                   "full_screen_over_lists",
                                                   "planes_bytes",
                                                   "tables_bytes",
                                                   "peak_bytes",
                                                   "uber_peak_bytes",
                                                   "build_ms",
                                                   "uber_build_ms",
                                                   "programs"};
  return metrics;
}

// Frames that are timed in turn, by number.
struct EffectsMeasurer::Frames {
  // Event times of a frame over the repetitions, whole and by launch [ns].
  struct Timed {
    Samples frame_ns;
    std::vector<Samples> launch_ns;

    void add(const FrameTimes& times) {
      frame_ns.push_back(times.shading_event_ns);
      launch_ns.resize(times.launch_event_ns.size());
      for (std::size_t i = 0; i < launch_ns.size(); ++i)
        launch_ns[i].push_back(times.launch_event_ns[i]);
    }
  };

  // An effect alone: a frame with it, less a frame with only what it needs.
  struct Alone {
    std::size_t with = 0, without = 0;  // indices of timed frames
  };

  std::vector<FrameRenderer*> renderers;
  std::vector<Timed> samples;
  std::size_t base = 0;
  std::vector<Alone> alone;

  std::size_t add(FrameRenderer& renderer) {
    const auto found = std::ranges::find(renderers, &renderer);
    if (found != renderers.end()) return static_cast<std::size_t>(found - renderers.begin());
    renderers.push_back(&renderer);
    return renderers.size() - 1;
  }
  void measure(const Repetitions& reps) {
    samples.assign(renderers.size(), {});
    while (reps.wantsMore({&samples.front().frame_ns}))
      for (std::size_t i = 0; i < renderers.size(); ++i) {
        stopIfInterrupted();
        samples[i].add(renderers[i]->shade());
      }
  }
  // The sum of the effects' own costs over the whole frame, or in one launch of it.
  Samples sum(const std::function<const Samples&(const Timed&)>& part) const {
    std::vector<const Samples*> with, without;
    for (const Alone& effect : alone) {
      with.push_back(&part(samples[effect.with]));
      without.push_back(&part(samples[effect.without]));
    }
    return sumAlone(part(samples[base]), with, without);
  }
};

EffectsMeasurer::EffectsMeasurer(BenchRun& run, Scene scene, std::string view_name)
    : run_(run), scene_(std::move(scene)), view_name_(std::move(view_name)) {}

// Under area lights the cone lights, too, read mean normals. What a normal map costs alone is then
// measured in the same way.
ShadingOptions EffectsMeasurer::optionsFor(EffectSet kept, EffectSet measured_in) const {
  ShadingOptions options = run_.shading();
  options.method = run_.method();
  if (measured_in.has(Effect::kLtc)) options.normal_method = NormalMethod::kToksvig;
  return withEffects(options, kept);
}

std::unique_ptr<EffectFrame> EffectsMeasurer::makeFrame(EffectSet kept, EffectSet measured_in,
                                                        Programs programs) {
  auto frame = std::make_unique<EffectFrame>();
  frame->scene = withEffects(scene_, kept);
  ShadingOptions options = optionsFor(kept, measured_in);
  options.programs = programs;
  frame->renderer = preparedFrame(run_, frame->scene, frame->scene.view(view_name_), options);
  return frame;
}

EffectFrame& EffectsMeasurer::keptFrame(EffectSet kept, EffectSet measured_in) {
  const bool means = measured_in.has(Effect::kLtc) && kept.has(Effect::kNormals);
  std::unique_ptr<EffectFrame>& frame =
      kept_[effectSetName(kept) + (means ? " by mean normals" : "")];
  if (!frame) frame = makeFrame(kept, measured_in, Programs::kPerMaterial);
  return *frame;
}

// Cold builds are remembered: a program that an earlier set built comes from the disk later.
double EffectsMeasurer::buildMs(const FrameRenderer& renderer, std::size_t& from_cache) {
  double total = 0;
  for (const ProgramBuild& build : renderer.builds()) {
    const double ms = (build.build_ns + build.first_enqueue_ns) * kMsPerNs;
    const std::string options = buildOptions(build.config);
    if (!build.from_disk_cache) cold_build_ms_.emplace(options, ms);
    const auto cold = cold_build_ms_.find(options);
    if (cold == cold_build_ms_.end()) ++from_cache;
    total += cold == cold_build_ms_.end() ? ms : cold->second;
  }
  return total;
}

// A set's own frame, the one program for all materials over the whole screen and over pixel lists,
// and what was allocated for the first two.
struct EffectsMeasurer::Compared {
  std::unique_ptr<EffectFrame> own, full_screen, lists;
  BufferUse before, after;  // of the set's own frame
  std::size_t uber_peak_bytes = 0;

  double heldBytes(BufferPurpose purpose) const {
    const auto held = [&](const BufferUse& use) {
      const auto found = use.by_purpose.find(purpose);
      return found == use.by_purpose.end() ? 0.0 : static_cast<double>(found->second.held);
    };
    return held(after) - held(before);
  }
  double peakBytes() const { return static_cast<double>(after.total.peak - before.total.held); }
};

EffectsMeasurer::Compared EffectsMeasurer::makeCompared(EffectSet set) {
  Device& device = run_.device();
  Compared compared;
  device.resetBufferPeaks();
  compared.before = device.bufferUse();
  compared.own = makeFrame(set, set, Programs::kPerMaterial);
  compared.after = device.bufferUse();
  device.resetBufferPeaks();
  compared.full_screen = makeFrame(set, set, Programs::kFullScreen);
  compared.uber_peak_bytes = device.bufferUse().total.peak - compared.after.total.held;
  compared.lists = makeFrame(set, set, Programs::kOneForAll);
  return compared;
}

// Frames that are timed in turn: the three compared ones first, then those that the sum of effects
// is made of.
EffectsMeasurer::Frames EffectsMeasurer::measureFrames(const Compared& compared, EffectSet set) {
  Frames frames;
  for (const auto* frame : {&compared.own, &compared.lists, &compared.full_screen})
    frames.add(*(*frame)->renderer);
  // A light is shaded for every effect that it falls on: lights of the set shine in all frames.
  const EffectSet lights =
      set.has(Effect::kEnvironment) ? EffectSet{Effect::kEnvironment} : EffectSet{};
  const std::vector<Effect> effects = set.without(lights).list();
  if (effects.size() > 1) {
    frames.base = frames.add(*keptFrame(lights, set).renderer);
    for (const Effect effect : effects) {
      const EffectSet needs = lights | effectNeeds(effect);
      const std::size_t with = frames.add(*keptFrame(needs | EffectSet{effect}, set).renderer);
      frames.alone.push_back({with, frames.add(*keptFrame(needs, set).renderer)});
    }
  }
  frames.measure(run_.reps());
  return frames;
}

// Collects the records of one case, all valid or none.
class EffectsMeasurer::CaseMaker {
 public:
  CaseMaker(const EffectsMeasurer& measurer, const std::string& case_name, EffectSet set,
            const Compared& compared)
      : measurer_(measurer), case_name_(case_name), set_(set), compared_(compared) {
    checkImages();
  }

  void add(const std::string& metric, const Samples& samples, const std::string& note = "") {
    Record record = measurer_.run_.record(effectsSpec(), case_name_, metric, samples, note);
    record.config["scene"] = CaseName{{measurer_.scene_.name, measurer_.view_name_}}.text();
    record.config["effects"] = effectSetName(set_);
    record.config["kernels"] = kernelOptions(*compared_.own->renderer);
    record.valid = failure_.empty();
    if (!record.valid) record.note = "not valid: " + failure_;
    records_.push_back(std::move(record));
  }
  void addTimes(const Frames& frames);
  void addBytes();
  void addSums(const Frames& frames);
  std::vector<Record> take() { return std::move(records_); }

 private:
  // The answer: all three programs must give the same bits.
  void checkImages() {
    const Image image = compared_.own->renderer->readRadiance();
    if (!isSane(image)) failure_ = "radiance values are negative or not finite";
    for (const auto* other : {&compared_.full_screen, &compared_.lists}) {
      const Image uber = (*other)->renderer->readRadiance();
      if (failure_.empty() && uber.pixels != image.pixels)
        failure_ = fmt::format("the program for all materials gives another image (relMSE {:.2g})",
                               relMse(uber, image));
    }
  }

  const EffectsMeasurer& measurer_;
  std::string case_name_;
  EffectSet set_;
  const Compared& compared_;
  std::string failure_;
  std::vector<Record> records_;
};

void EffectsMeasurer::CaseMaker::addTimes(const Frames& frames) {
  const auto milliseconds = [](Samples ns) {
    for (double& sample : ns) sample *= kMsPerNs;
    return ns;
  };
  const Samples& own = frames.samples[0].frame_ns;
  const Samples& lists = frames.samples[1].frame_ns;
  const Samples& full_screen = frames.samples[2].frame_ns;
  add("shading_ms", milliseconds(own), "kernel events, specialised programs");
  add("uber_ms", milliseconds(full_screen), "one program with every effect, full screen");
  add("uber_over_specialised", ratios(full_screen, own),
      "one program with every effect, full screen, over specialised programs on pixel lists");
  add("uber_on_lists_over_specialised", ratios(lists, own),
      "the same program on the pixel lists of the materials");
  add("full_screen_over_lists", ratios(full_screen, lists),
      "the program with every effect: pixels as on the screen, over lists by material");
}

void EffectsMeasurer::CaseMaker::addBytes() {
  const double planes = compared_.heldBytes(BufferPurpose::kPlanes);
  add("planes_bytes", {planes}, "rasterized planes");
  add("tables_bytes",
      {compared_.peakBytes() - planes - compared_.heldBytes(BufferPurpose::kRadiance)},
      "all other buffers but the radiance: tables, textures, lights, parameters");
  add("peak_bytes", {compared_.peakBytes()}, "device buffers really allocated, most at once");
  add("uber_peak_bytes", {static_cast<double>(compared_.uber_peak_bytes)});
}

void EffectsMeasurer::CaseMaker::addSums(const Frames& frames) {
  if (frames.alone.empty()) return;
  add("mixed_over_sum",
      ratios(frames.samples[0].frame_ns,
             frames.sum([](const Frames::Timed& s) -> const Samples& { return s.frame_ns; })),
      fmt::format("frame over the sum of its effects alone; wanted at most {}",
                  kWantedMixedOverSum));
  // The material that fares worst; all frames have the same pixel lists.
  const PixelPlanes& planes = compared_.own->renderer->planes();
  Samples worst;
  std::string name;
  for (std::size_t i = 0; i < planes.lists.size(); ++i) {
    if (planes.lists[i].count < kTimedShare * static_cast<double>(planes.covered_px)) continue;
    const auto launch = [i](const Frames::Timed& s) -> const Samples& { return s.launch_ns[i]; };
    const Samples ratio = ratios(launch(frames.samples[0]), frames.sum(launch));
    if (!worst.empty() && summarize(ratio).median <= summarize(worst).median) continue;
    worst = ratio;
    name = measurer_.scene_.materials[planes.lists[i].material].name;
  }
  if (!worst.empty())
    add("mixed_over_sum_worst", worst, fmt::format("pixels of material {}", name));
}

std::vector<Record> EffectsMeasurer::measure(const std::string& case_name, EffectSet set) {
  const Compared compared = makeCompared(set);
  std::size_t own_cached = 0, uber_cached = 0;
  const double build_ms = buildMs(*compared.own->renderer, own_cached);
  const double uber_build_ms = buildMs(*compared.full_screen->renderer, uber_cached);
  const Frames frames = measureFrames(compared, set);
  CaseMaker maker(*this, case_name, set, compared);
  maker.addTimes(frames);
  maker.addBytes();
  const auto note = [](std::size_t cached) {
    return cached == 0 ? std::string("clBuildProgram and first launches, from source")
                       : fmt::format("{} programs came from the disk cache", cached);
  };
  maker.add("build_ms", {build_ms}, note(own_cached));
  maker.add("uber_build_ms", {uber_build_ms}, note(uber_cached));
  maker.add("programs", {static_cast<double>(compared.own->renderer->configs().size())});
  maker.addSums(frames);
  return maker.take();
}

}  // namespace glintmark
