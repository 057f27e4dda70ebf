#include "host/experiment/tan05/tan05_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/experiment/frame_timing.h"
#include "host/experiment/frame_truth.h"
#include "host/experiment/shifted_view.h"
#include "host/experiment/survival.h"
#include "host/experiment/tan05/tan05_table.h"
#include "host/frame/effect/normal_maps.h"
#include "host/report/metrics.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/picture/tonemap.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr int kPaperSize_px = 500;
// Of errors without times: distances shrink what is seen, not what it means.
constexpr double kDifferenceGain = 4;

Image display(const Image& radiance, const Scene& scene) {
  return toneMap(radiance, {.exposure = scene.post.exposure});
}

// Display values where `coverage` covers, in one row.
Image coveredDisplay(const Image& radiance, const Scene& scene) {
  return display(coveredPixels(radiance), scene);
}

struct Truth {
  Image radiance;
  double standard_error = 0;  // of display values, as a colour error
};

Truth measureTruth(BenchRun& run, const Tan05Scene& scene, const View& view,
                   const Tan05Settings& settings) {
  ReplicatedTruth truth =
      truthOf(run, scene.scene, view, settings.shading, settings.truth_spp, scene.textures);
  const double error =
      errorOfMean(truth.images.mean, truth.replicates, [&](const Image& off, const Image& mean) {
        return colourError(coveredDisplay(off, scene.scene), coveredDisplay(mean, scene.scene));
      });
  return {std::move(truth.images.mean), error};
}

std::unique_ptr<FrameRenderer> methodFrame(BenchRun& run, const Tan05Scene& scene, const View& view,
                                           const Tan05Settings& settings,
                                           const Tan05Method& method) {
  ShadingOptions options = settings.shading;
  options.normal_method = method.method;
  options.mixture_order = method.order;
  options.peaks = method.peaks;
  if (method.lobes > 0) options.lobes = method.lobes;
  if (method.probes_across > 0) options.probes_across = method.probes_across;
  return preparedFrame(run, scene.scene, view, options, scene.textures);
}

std::string caseOf(const Tan05Scene& scene, const std::string& view_name,
                   const Tan05Method& method) {
  return CaseName{{scene.scene.name, view_name, method.name}}.text();
}

// Those in which no driver has died: the others are measured without them.
std::vector<Tan05Method> methodsLeft(const Tan05Scene& scene, const std::string& view_name) {
  std::vector<Tan05Method> methods = tan05MethodsOf(scene.scene);
  std::erase_if(methods, [&](const Tan05Method& method) {
    return isLost(tan05Spec().name, caseOf(scene, view_name, method));
  });
  return methods;
}

// The display pictures of a zoom-out by one method, whole frames.
template <typename Render>
std::vector<Image> zoomFrames(const Tan05Scene& scene, const View& view, Render render) {
  std::vector<Image> frames;
  frames.reserve(kZoomFrames);
  for (int i = 0; i < kZoomFrames; ++i)
    frames.push_back(display(render(atDistance(view, std::pow(kZoomStep, i))), scene.scene));
  return frames;
}

std::vector<double> frameToFrame(const std::vector<Image>& frames,
                                 const std::vector<Image>& truth) {
  std::vector<double> errors;
  for (std::size_t i = 1; i < frames.size(); ++i)
    errors.push_back(changeError(frames[i - 1], frames[i], truth[i - 1], truth[i]));
  return errors;
}

Image differencePicture(const Image& picture, const Image& truth) {
  Image difference = picture;
  for (std::size_t i = 0; i < difference.pixels.size(); ++i)
    difference.pixels[i] = std::min(
        1.0f, static_cast<float>(kDifferenceGain) * std::abs(picture.pixels[i] - truth.pixels[i]));
  return difference;
}

// Truth, then every method, and after them the differences.
Image comparison(const std::vector<std::pair<std::string, Image>>& pictures) {
  std::vector<std::pair<std::string, Image>> all = pictures;
  for (std::size_t i = 1; i < pictures.size(); ++i)
    all.emplace_back(fmt::format("|{} - truth| x {}", pictures[i].first, kDifferenceGain),
                     differencePicture(pictures[i].second, pictures.front().second));
  return pictureStrip(all);
}

// How wrong a picture is, or the mean over several.
struct Tan05Errors {
  double colour = 0, bias = 0, rel_mse = 0, truth_stderr = 0;
  std::string fault = {};
};

Tan05Errors errorsOf(const Scene& scene, const Image& image, const Truth& truth) {
  std::string fault = radianceFault(image);
  if (fault.empty() && truth.standard_error >= 1) fault = "the truth's standard error is 1 or more";
  if (!fault.empty()) return {1, 0, 1, truth.standard_error, fault};
  const Image row = coveredPixels(image), right = coveredPixels(truth.radiance);
  return {colourError(display(row, scene), display(right, scene)), relativeBias(row, right),
          relMse(row, right), truth.standard_error};
}

Tan05Errors meanErrors(const std::vector<Tan05Errors>& errors) {
  Tan05Errors mean;
  for (const Tan05Errors& one : errors) {
    for (const auto member : {&Tan05Errors::colour, &Tan05Errors::bias, &Tan05Errors::rel_mse,
                              &Tan05Errors::truth_stderr})
      mean.*member += one.*member / static_cast<double>(errors.size());
    if (mean.fault.empty()) mean.fault = one.fault;
  }
  return mean;
}

void addErrors(BenchRun& run, const std::string& case_name, const Tan05Errors& errors,
               std::vector<Record>& records) {
  const auto add = [&](const char* metric, double value) {
    records.push_back(run.record(tan05Spec(), case_name, metric, {value}));
  };
  add("colour_error", errors.colour);
  records.back().paper = tan05PaperError(case_name);
  add("bias", errors.bias);
  add("rel_mse", errors.rel_mse);
  add("truth_stderr", errors.truth_stderr);
  if (errors.fault.empty()) return;
  for (Record& bad : records) {
    bad.valid = false;
    bad.note = "not valid: " + errors.fault;
  }
}

std::vector<double> inverse(std::vector<double> samples_ms) {
  for (double& sample : samples_ms) sample = 1000 / sample;
  return samples_ms;
}

}  // namespace

const std::vector<Tan05Method>& tan05Methods() {
  static const std::vector<Tan05Method> methods = {
      {"gmm", NormalMethod::kGmm},
      {.name = "lobes_8", .method = NormalMethod::kGmm, .lobes = 8},
      {.name = "one_row", .method = NormalMethod::kGmm, .probes_across = 1},
      {"unaligned", NormalMethod::kGmm, MixtureOrder::kIndependent},
      {"vmf_lobes", NormalMethod::kVmfLobes},
      {"anisotropic", NormalMethod::kAnisotropic},
      {"toksvig", NormalMethod::kToksvig},
      {"vmf", NormalMethod::kVmf},
      {"lean", NormalMethod::kLean},
      {"leadr", NormalMethod::kLeadr},
      {"fournier", NormalMethod::kFournier},
      {.name = "peaks_4", .method = NormalMethod::kFournier, .peaks = 4},
      {"mip", NormalMethod::kMip},
      {"fixed", NormalMethod::kFixed}};
  return methods;
}

std::vector<Tan05Method> tan05MethodsOf(const Scene& scene) {
  std::vector<Tan05Method> methods = tan05Methods();
  std::erase_if(methods,
                [&](const Tan05Method& method) { return !takesLobesOf(method.method, scene); });
  return methods;
}

const std::vector<std::string>& tan05ViewMetrics() {
  static const std::vector<std::string> metrics = {"shading_ms",   "fps",  "frame_to_frame_error",
                                                   "colour_error", "bias", "rel_mse",
                                                   "truth_stderr"};
  return metrics;
}

const std::vector<std::string>& tan05DistanceMetrics() {
  static const std::vector<std::string> metrics = {"colour_error", "bias", "rel_mse",
                                                   "truth_stderr"};
  return metrics;
}

Tan05Settings tan05Settings(const BenchRun& run) {
  Tan05Settings settings;
  settings.shading = run.shading();
  settings.shading.width_px = settings.shading.height_px = kPaperSize_px;
  return settings;
}

Tan05Scene::Tan05Scene(BenchRun& run, const std::string& name)
    : scene(openScene(run.session().common, name)),
      textures(std::make_shared<NormalTextures>(run.device())) {}

View atDistance(const View& view, double factor) {
  if (!view.orbit) {
    View moved = view;
    moved.eye = view.target + (view.eye - view.target) * factor;
    return moved;
  }
  Orbit orbit = *view.orbit;
  orbit.distance *= factor;
  return orbitView(view, orbit);
}

Tan05View measureTan05View(BenchRun& run, const Tan05Scene& scene, const View& view,
                           const Tan05Settings& settings) {
  const Truth truth = measureTruth(run, scene, view, settings);
  const std::vector<Image> truth_zoom = zoomFrames(scene, view, [&](const View& moved) {
    return measureTruth(run, scene, moved, settings).radiance;
  });
  std::vector<std::unique_ptr<FrameRenderer>> renderers;
  std::vector<Image> images;
  std::vector<std::pair<std::string, Image>> pictures = {
      {"truth", display(truth.radiance, scene.scene)}};
  const std::vector<Tan05Method> methods = methodsLeft(scene, view.name);
  for (const Tan05Method& method : methods) {
    const CaseAtHand at_hand(tan05Spec().name, caseOf(scene, view.name, method));
    renderers.push_back(methodFrame(run, scene, view, settings, method));
    images.push_back(renderers.back()->readRadiance());
    pictures.emplace_back(method.name, display(images.back(), scene.scene));
  }
  const std::vector<Samples> times_ms = shadeInTurn(renderers, run.reps());

  Tan05View result;
  for (std::size_t m = 0; m < renderers.size(); ++m) {
    const Tan05Method& method = methods[m];
    const std::string name = caseOf(scene, view.name, method);
    const CaseAtHand at_hand(tan05Spec().name, name);
    const std::vector<Image> zoom = zoomFrames(scene, view, [&](const View& moved) {
      return methodFrame(run, scene, moved, settings, method)->readRadiance();
    });
    std::vector<Record>& records = result.records[method.name];
    records.push_back(
        run.record(tan05Spec(), name, "shading_ms", times_ms[m], "kernel events, methods in turn"));
    records.push_back(run.record(tan05Spec(), name, "fps", inverse(times_ms[m]), "at 500x500"));
    records.back().paper = tan05PaperFps(name);
    records.push_back(
        run.record(tan05Spec(), name, "frame_to_frame_error", frameToFrame(zoom, truth_zoom)));
    addErrors(run, name, errorsOf(scene.scene, images[m], truth), records);
  }
  result.picture = comparison(pictures);
  return result;
}

Tan05View measureTan05Distance(BenchRun& run, const Tan05Scene& scene, const View& view,
                               const std::string& view_name, const Tan05Settings& settings) {
  const std::vector<Tan05Method> methods = methodsLeft(scene, view_name);
  std::map<std::string, std::vector<Tan05Errors>> errors;
  for (const auto& [right_px, up_px] : kShifts_px) {
    const View shifted = shiftedView(view, right_px, up_px, settings.shading.height_px);
    const Truth truth = measureTruth(run, scene, shifted, settings);
    for (const Tan05Method& method : methods) {
      const CaseAtHand at_hand(tan05Spec().name, caseOf(scene, view_name, method));
      errors[method.name].push_back(errorsOf(
          scene.scene, methodFrame(run, scene, shifted, settings, method)->readRadiance(), truth));
    }
  }
  Tan05View result;
  for (const Tan05Method& method : methods)
    addErrors(run, caseOf(scene, view_name, method), meanErrors(errors[method.name]),
              result.records[method.name]);
  return result;
}

}  // namespace glintmark
