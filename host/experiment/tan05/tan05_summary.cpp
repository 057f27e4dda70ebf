#include "host/experiment/tan05/tan05_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "host/experiment/tan05/tan05_table.h"
#include "host/experiment/tao21/tao21_view.h"
#include "host/filter/normal_map_generators.h"
#include "host/frame/ground_truth.h"
#include "host/mixture/normal_mixture.h"
#include "host/reference/texture.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

constexpr const char* kKnobView = "oblique";
constexpr const char* kSummaryView = "near";
constexpr int kLobeCounts[] = {1, 2, 4, 8};
constexpr int kAnisotropies[] = {1, 2, 4, 8, 16};
constexpr int kOneLaneReps = 5;
constexpr int kFitSize_px = 512;
constexpr double kFraction = 0x1p-32;

using Samples = std::vector<double>;

// Of a full frame at the command line's size.
ShadingOptions fullOptions(const BenchRun& run, NormalMethod method) {
  const ImageSize size = parseSize(run.options().size);
  ShadingOptions options = tan05Settings(run).shading;
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  options.normal_method = method;
  return options;
}

std::unique_ptr<FrameRenderer> makeRenderer(BenchRun& run, const Tan05Scene& scene,
                                            const View& view, const ShadingOptions& options) {
  auto renderer = std::make_unique<FrameRenderer>(run.device(), scene.scene, view, options,
                                                  run.session().common.threads, scene.textures);
  renderer->prepare();
  renderer->shade();
  return renderer;
}

// Times of `first` over those of `second`, in turn.
Samples ratioInTurn(FrameRenderer& first, FrameRenderer& second, int reps) {
  Samples ratio;
  for (int rep = 0; rep < reps; ++rep) {
    const double first_ms = shadeMs(first);
    ratio.push_back(first_ms / shadeMs(second));
  }
  return ratio;
}

// Bytes of texels that the fetch reads, mean over the covered pixels. The lanes of a work-item read
// together: as many probes as the one that needs most, and two levels, eight texels, if one of them
// blends two; what a lane does not need it reads with weight 0.
double bytesPerPixel(const PixelPlanes& planes, const NormalMap& map, int most_probes,
                     std::size_t texel_bytes, std::uint32_t lanes) {
  const auto u = planes.plane(Plane::kUFrac), v = planes.plane(Plane::kVFrac);
  const auto dudx = planes.plane<float>(Plane::kDudx), dvdx = planes.plane<float>(Plane::kDvdx);
  const auto dudy = planes.plane<float>(Plane::kDudy), dvdy = planes.plane<float>(Plane::kDvdy);
  const int levels = mipLevelCount(map.width_px, map.height_px);
  double texels = 0, pixels = 0;
  for (const PixelList& list : planes.lists)
    for (std::uint32_t first = 0; first < list.count; first += lanes) {
      const std::uint32_t count = std::min(lanes, list.count - first);
      int probes = 1, texels_each = 4;
      for (std::uint32_t i = list.offset + first; i < list.offset + first + count; ++i) {
        const reference::ProbeLine line = reference::footprintProbes(
            map.width_px, map.height_px, levels, {u[i] * kFraction, v[i] * kFraction},
            {{dudx[i], dvdx[i]}, {dudy[i], dvdy[i]}}, most_probes);
        probes = std::max(probes, line.count);
        if (line.level > std::floor(line.level)) texels_each = 8;
      }
      texels += static_cast<double>(count) * probes * texels_each;
      pixels += count;
    }
  return pixels > 0 ? texels * static_cast<double>(texel_bytes) / pixels : 0;
}

struct Knob {
  std::string name;
  int value = 0;

  explicit Knob(const std::string& case_name) {
    const std::size_t slash = case_name.rfind('/'), equals = case_name.find('=');
    name = case_name.substr(slash + 1, equals - slash - 1);
    std::from_chars(case_name.data() + equals + 1, case_name.data() + case_name.size(), value);
  }
  void apply(ShadingOptions& options) const {
    (name == "lobes" ? options.lobes : options.anisotropy) = value;
  }
};

const NormalMap& firstMap(const Tan05Scene& scene) {
  return *scene.scene.materials.front().normal_map->map;
}

// The texel's bytes and probes of a mixture with these options.
double mixtureBytes(const BenchRun& run, const FrameRenderer& renderer, const Tan05Scene& scene,
                    const ShadingOptions& options) {
  const int lobes =
      options.lobes > 0 ? options.lobes : scene.scene.materials.front().normal_map->lobes;
  return bytesPerPixel(renderer.planes(), firstMap(scene), options.anisotropy,
                       static_cast<std::size_t>(lobes) * sizeof(float4),
                       static_cast<std::uint32_t>(run.info().width));
}

}  // namespace

std::vector<std::string> tan05KnobCases() {
  std::vector<std::string> cases;
  for (const int lobes : kLobeCounts)
    cases.push_back(fmt::format("disk/{}/lobes={}", kKnobView, lobes));
  for (const int anisotropy : kAnisotropies)
    cases.push_back(fmt::format("disk/{}/anisotropy={}", kKnobView, anisotropy));
  return cases;
}

const std::vector<std::string>& tan05KnobMetrics() {
  static const std::vector<std::string> metrics = {"shading_ms", "bytes_per_px", "colour_error"};
  return metrics;
}

std::vector<Record> measureTan05Knob(BenchRun& run, const Tan05Scene& scene,
                                     const std::string& case_name) {
  const Knob knob(case_name);
  const View& view = scene.scene.view(kKnobView);
  ShadingOptions full = fullOptions(run, NormalMethod::kGmm);
  knob.apply(full);
  const auto renderer = makeRenderer(run, scene, view, full);
  Samples times_ms;
  for (int rep = 0; rep < run.options().reps; ++rep) times_ms.push_back(shadeMs(*renderer));

  Tan05Settings settings = tan05Settings(run);
  knob.apply(settings.shading);
  const TruthImages truth = renderTruth(
      run.device(), scene.scene, view, settings.shading, settings.truth_spp,
      [](int) { stopIfInterrupted(); }, settings.threads, scene.textures);
  const auto small = makeRenderer(run, scene, view, settings.shading);
  const auto display = [&](const Image& image) {
    return toneMap(coveredPixels(image), {.exposure = scene.scene.post.exposure});
  };
  const double error = colourError(display(small->readRadiance()), display(truth.mean));
  return {tan05Record(run, case_name, "shading_ms", "ms", times_ms, "kernel events"),
          tan05Record(run, case_name, "bytes_per_px", "bytes",
                      {mixtureBytes(run, *renderer, scene, full)}, "texels read"),
          tan05Record(run, case_name, "colour_error", "1", {error}, "at 500x500")};
}

const std::vector<std::string>& tan05SummaryMetrics() {
  static const std::vector<std::string> metrics = {"gmm_over_toksvig", "fournier_over_gmm",
                                                   "speedup_vs_w1",    "half_over_float",
                                                   "fit_ms",           "bytes_per_px"};
  return metrics;
}

std::vector<Record> measureTan05Summary(BenchRun& run, const Tan05Scene& scene) {
  const View& view = scene.scene.view(kSummaryView);
  const int reps = run.options().reps;
  const ShadingOptions options = fullOptions(run, NormalMethod::kGmm);
  const auto gmm = makeRenderer(run, scene, view, options);
  const auto toksvig = makeRenderer(run, scene, view, fullOptions(run, NormalMethod::kToksvig));
  const auto fournier = makeRenderer(run, scene, view, fullOptions(run, NormalMethod::kFournier));
  ShadingOptions half_options = options, narrow_options = options;
  half_options.half_texels = true;
  narrow_options.lanes = 1;
  const auto half = makeRenderer(run, scene, view, half_options);
  const auto narrow = makeRenderer(run, scene, view, narrow_options);
  const Samples one_lane =
      options.lanes > 1 ? ratioInTurn(*narrow, *gmm, std::min(reps, kOneLaneReps)) : Samples{1};
  const bool same = relMse(gmm->readRadiance(), narrow->readRadiance()) == 0;
  const NormalMixtures fitted = fitNormalMixtures(
      generateNormalMap({.kind = "disk", .size_px = kFitSize_px}),
      {.threads = run.session().common.threads}, [](double) { stopIfInterrupted(); });

  const auto record = [&](const char* metric, const char* unit, const Samples& samples,
                          const std::string& note) {
    return tan05Record(run, "all", metric, unit, samples, note);
  };
  std::vector<Record> records = {
      record("gmm_over_toksvig", "1", ratioInTurn(*gmm, *toksvig, reps), "kernel events, in turn"),
      record("fournier_over_gmm", "1", ratioInTurn(*fournier, *gmm, std::min(reps, kOneLaneReps)),
             "kernel events, in turn"),
      record("speedup_vs_w1", "1", one_lane, "kernel events, in turn"),
      record("half_over_float", "1", ratioInTurn(*half, *gmm, reps), "kernel events, in turn"),
      record("fit_ms", "ms", {fitted.fit_ms}, "512x512, four lobes, not from the cache"),
      record("bytes_per_px", "bytes", {mixtureBytes(run, *gmm, scene, options)}, "texels read")};
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
