#include "host/experiment/tan05/tan05_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiment/frame_timing.h"
#include "host/experiment/frame_truth.h"
#include "host/experiment/summary_table.h"
#include "host/experiment/tan05/tan05_table.h"
#include "host/filter/normal_map_generators.h"
#include "host/frame/effect/normal_maps.h"
#include "host/mixture/normal_mixture.h"
#include "host/reference/texture.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr const char* kKnobView = "oblique";
constexpr const char* kSummaryView = "near";
constexpr const char *kLobesKnob = "lobes", *kAnisotropyKnob = "anisotropy";
constexpr int kLobeCounts[] = {1, 2, 4, 8};
constexpr int kAnisotropies[] = {1, 2, 4, 8, 16};
constexpr int kFitSize_px = 512;
constexpr double kFraction = 0x1p-32;

// Of a full frame at the command line's size.
ShadingOptions fullOptions(const BenchRun& run, NormalMethod method) {
  ShadingOptions options = run.shading();
  options.normal_method = method;
  return options;
}

// Bytes of texels that the fetch reads, mean over the covered pixels. The lanes of a work-item read
// together: as many probes as the one that needs most, and two levels, eight texels, if one of them
// blends two; what a lane does not need it reads with weight 0.
double bytesPerPixel(const PixelPlanes& planes, const NormalMap& map,
                     const reference::ProbeLimits& most, std::size_t texel_bytes,
                     std::uint32_t lanes) {
  const auto u = planes.plane(Plane::kUFrac), v = planes.plane(Plane::kVFrac);
  const auto dudx = planes.plane<float>(Plane::kDudx), dvdx = planes.plane<float>(Plane::kDvdx);
  const auto dudy = planes.plane<float>(Plane::kDudy), dvdy = planes.plane<float>(Plane::kDvdy);
  const int levels = mipLevelCount(map.width_px, map.height_px);
  double texels = 0, pixels = 0;
  for (const PixelList& list : planes.lists)
    for (std::uint32_t first = 0; first < list.count; first += lanes) {
      const std::uint32_t count = std::min(lanes, list.count - first);
      int probes = 1, rows = 1, texels_each = 4;
      for (std::uint32_t i = list.offset + first; i < list.offset + first + count; ++i) {
        const reference::ProbeGrid grid = reference::footprintProbes(
            map.width_px, map.height_px, levels, {u[i] * kFraction, v[i] * kFraction},
            {{dudx[i], dvdx[i]}, {dudy[i], dvdy[i]}}, most);
        probes = std::max(probes, grid.count);
        rows = std::max(rows, grid.rows);
        if (grid.level > std::floor(grid.level)) texels_each = 8;
      }
      texels += static_cast<double>(count) * probes * rows * texels_each;
      pixels += count;
    }
  return pixels > 0 ? texels * static_cast<double>(texel_bytes) / pixels : 0;
}

// Options with the case's knob turned.
ShadingOptions turned(ShadingOptions options, const CaseName& name) {
  if (name.value(kLobesKnob))
    options.lobes = static_cast<int>(name.number(kLobesKnob));
  else
    options.anisotropy = static_cast<int>(name.number(kAnisotropyKnob));
  return options;
}

const NormalMap& firstMap(const Tan05Scene& scene) {
  return *scene.scene.materials.front().normal_map->map;
}

// The texel's bytes and probes of a mixture with these options.
double mixtureBytes(const BenchRun& run, const FrameRenderer& renderer, const Tan05Scene& scene,
                    const ShadingOptions& options) {
  const int lobes =
      options.lobes > 0 ? options.lobes : scene.scene.materials.front().normal_map->lobes;
  return bytesPerPixel(renderer.planes(), firstMap(scene),
                       {options.anisotropy, options.probes_across, std::sqrt(lobes)},
                       static_cast<std::size_t>(lobes) * sizeof(float4),
                       static_cast<std::uint32_t>(run.info().width));
}

}  // namespace

std::vector<std::string> tan05KnobCases() {
  std::vector<std::string> cases;
  const auto add = [&](const char* knob, int value) {
    cases.push_back(CaseName{{"disk", kKnobView}, {{knob, value}}}.text());
  };
  for (const int lobes : kLobeCounts) add(kLobesKnob, lobes);
  for (const int anisotropy : kAnisotropies) add(kAnisotropyKnob, anisotropy);
  return cases;
}

const std::vector<std::string>& tan05KnobMetrics() {
  static const std::vector<std::string> metrics = {"shading_ms", "bytes_per_px", "colour_error"};
  return metrics;
}

std::vector<Record> measureTan05Knob(BenchRun& run, const Tan05Scene& scene,
                                     const std::string& case_name) {
  const CaseName name = CaseName::parse(case_name);
  const View& view = scene.scene.view(name.word(1));
  const ShadingOptions full = turned(fullOptions(run, NormalMethod::kGmm), name);
  const auto renderer = preparedFrame(run, scene.scene, view, full, scene.textures);
  const Samples times_ms = shadeTimesMs(*renderer, run.reps());

  Tan05Settings settings = tan05Settings(run);
  settings.shading = turned(settings.shading, name);
  const TruthImages truth =
      truthOf(run, scene.scene, view, settings.shading, settings.truth_spp, scene.textures).images;
  const auto small = preparedFrame(run, scene.scene, view, settings.shading, scene.textures);
  const auto display = [&](const Image& image) {
    return toneMap(coveredPixels(image), {.exposure = scene.scene.post.exposure});
  };
  const double error = colourError(display(small->readRadiance()), display(truth.mean));
  return {run.record(tan05Spec(), case_name, "shading_ms", times_ms, "kernel events"),
          run.record(tan05Spec(), case_name, "bytes_per_px",
                     {mixtureBytes(run, *renderer, scene, full)}, "texels read"),
          run.record(tan05Spec(), case_name, "colour_error", {error}, "at 500x500")};
}

const std::vector<std::string>& tan05SummaryMetrics() {
  static const std::vector<std::string> metrics = {"gmm_over_toksvig", "fournier_over_gmm",
                                                   "speedup_vs_w1",    "half_over_float",
                                                   "fit_ms",           "bytes_per_px"};
  return metrics;
}

std::vector<Record> measureTan05Summary(BenchRun& run, const Tan05Scene& scene) {
  const View& view = scene.scene.view(kSummaryView);
  const Repetitions reps = run.reps();
  // One row of probes, as the paper's filter: what its ratios are of.
  const auto one_row = [&](NormalMethod method) {
    ShadingOptions options = fullOptions(run, method);
    options.probes_across = 1;
    return options;
  };
  const ShadingOptions options = one_row(NormalMethod::kGmm);
  const auto frame = [&](const ShadingOptions& chosen) {
    return preparedFrame(run, scene.scene, view, chosen, scene.textures);
  };
  const auto gmm = frame(options);
  const auto toksvig = frame(one_row(NormalMethod::kToksvig));
  const auto fournier = frame(one_row(NormalMethod::kFournier));
  ShadingOptions half_options = options, narrow_options = options;
  half_options.half_texels = true;
  narrow_options.lanes = 1;
  const auto half = frame(half_options), narrow = frame(narrow_options);
  const Samples one_lane = options.lanes > 1
                               ? shadeInTurn(*narrow, *gmm, reps.atMost(kOneLaneReps)).ratios()
                               : Samples{1};
  const bool same = relMse(gmm->readRadiance(), narrow->readRadiance()) == 0;
  MixtureOptions fit =
      mixtureOptions(NormalMapSource{}.lobes, options.mixture_order, options.mixture_iterations);
  fit.threads = run.threads();
  const NormalMixtures fitted =
      fitNormalMixtures(generateNormalMap({.kind = "disk", .size_px = kFitSize_px}), fit,
                        [](double) { stopIfInterrupted(); });

  const auto record = [&](const char* metric, const Samples& samples, const std::string& note) {
    return run.record(tan05Spec(), kAllCase, metric, samples, note);
  };
  std::vector<Record> records = {
      record("gmm_over_toksvig", shadeInTurn(*gmm, *toksvig, reps).ratios(),
             "kernel events, in turn"),
      record("fournier_over_gmm", shadeInTurn(*fournier, *gmm, reps.atMost(kOneLaneReps)).ratios(),
             "kernel events, in turn"),
      record("speedup_vs_w1", one_lane, "kernel events, in turn"),
      record("half_over_float", shadeInTurn(*half, *gmm, reps).ratios(), "kernel events, in turn"),
      record("fit_ms", {fitted.fit_ms}, "512x512, four lobes, not from the cache"),
      record("bytes_per_px", {mixtureBytes(run, *gmm, scene, options)}, "texels read")};
  records[0].paper = 125.0 / 120;
  records[1].paper = 120.0 / 13;
  records[4].paper = kTan05FitMs;
  if (!same)
    for (Record& bad : records) {
      bad.valid = false;
      bad.note = "not valid: one lane gives another image";
    }
  return records;
}

}  // namespace glintmark
