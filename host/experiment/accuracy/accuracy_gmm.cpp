// Knobs of Gaussian mixtures of normals, and the other ways to filter them as rivals. [TAN05]
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host/core/error.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/accuracy/accuracy_truth.h"
#include "host/experiment/accuracy/knob_settings.h"
#include "host/experiment/shifted_view.h"
#include "host/frame/effect/normal_maps.h"
#include "host/mixture/normal_mixture.h"
#include "host/ocl/switches.h"

namespace glintmark {
namespace {

constexpr int kIterations[] = {1, 2, 4, 8, 16};
constexpr int kFitReps = 3;
constexpr int kSupersamples[] = {1, 4, 16, 64};
// Texels and pixels must not be in step: four shifts, of half the samples that one view had.
constexpr SampledTruthSettings kGmmTruth = {PrincipalMetric::kColourError, 480, 512,
                                            static_cast<int>(std::size(kShifts_px))};

std::vector<AccuracySetting> gmmSettings() {
  KnobSettings knobs("gmm");
  std::vector<AccuracySetting> all;
  const auto add = [&](const std::string& name, bool is_default,
                       std::function<void(ShadingOptions&)> apply) {
    all.push_back({name, std::move(apply), is_default ? kAccuracyDefault : kAccuracyKnob});
  };
  for (const int lobes : switchNamed("LOBES").sweep.values)
    add(fmt::format("lobes={}", lobes), lobes == NormalMapSource{}.lobes,
        [lobes](ShadingOptions& o) { o.lobes = lobes; });
  for (const MixtureOrder order :
       {MixtureOrder::kColours, MixtureOrder::kScanline, MixtureOrder::kIndependent})
    add(fmt::format("alignment={}", mixtureOrderName(order)),
        order == ShadingOptions{}.mixture_order,
        [order](ShadingOptions& o) { o.mixture_order = order; });
  knobs.moveTo(all, {"probes", "probes_across", "texels"});
  for (const int iterations : kIterations)
    add(fmt::format("fit_iterations={}", iterations), iterations == MixtureOptions{}.max_iterations,
        [iterations](ShadingOptions& o) { o.mixture_iterations = iterations; });
  knobs.moveRestTo(all);
  for (const int peaks : switchNamed("PEAKS").sweep.values)
    all.push_back({fmt::format("peaks={}", peaks),
                   [peaks](ShadingOptions& o) {
                     o.normal_method = NormalMethod::kFournier;
                     o.peaks = peaks;
                   },
                   kAccuracyRival});
  for (const int samples : kSupersamples)
    all.push_back({fmt::format("supersamples={}", samples), {}, kAccuracySampled, samples});
  return all;
}

// Without the method that has fewer lobes than some scene, which is said. As they ship, scenes go
// with every method.
std::vector<AccuracySetting> gmmSettingsOf(const BenchRun& run,
                                           const std::vector<std::string>& scenes) {
  std::vector<AccuracySetting> settings = gmmSettings();
  CommonOptions quiet = run.session().common;
  quiet.quiet = true;
  if (quiet.overrides.empty()) return settings;
  for (const std::string& scene : scenes) {
    const std::string name = scene.substr(0, scene.find('/'));
    if (takesLobesOf(NormalMethod::kAnisotropic, openScene(quiet, name))) continue;
    if (std::erase_if(settings,
                      [](const AccuracySetting& setting) {
                        return setting.name == "method=anisotropic";
                      }) > 0 &&
        !run.session().common.quiet)
      fmt::print(stderr, "{}\n", withoutAnisotropicNote(name));
  }
  return settings;
}

// The normal map of the scene's first material that has one.
const NormalMapSource& normalMapOf(const Scene& scene) {
  const auto found = std::ranges::find_if(
      scene.materials, [](const Material& material) { return material.normal_map.has_value(); });
  if (found == scene.materials.end()) throw Error("no material of the scene has a normal map");
  return *found->normal_map;
}

class GmmSweep : public SampledSweep {
 public:
  using SampledSweep::SampledSweep;

 protected:
  // Of knobs that the fit knows.
  std::vector<double> fitRatios(const AccuracyStage& stage,
                                const AccuracySetting& setting) const override {
    if (setting.role == kAccuracyDefault) return {1};
    const std::string knob = knobOf(setting.name);
    if (knob != "lobes" && knob != "alignment" && knob != "fit_iterations") return {};
    const NormalMapSource& source = normalMapOf(stage.scene());
    ShadingOptions options = stage.options();
    const int threads = stage.run().threads();
    const auto fit = [&] {
      const int lobes = options.lobes > 0 ? options.lobes : source.lobes;
      MixtureOptions fit_options =
          mixtureOptions(lobes, options.mixture_order, options.mixture_iterations);
      fit_options.threads = threads;
      return fitNormalMixtures(*source.map, fit_options).fit_ms;
    };
    const ShadingOptions standard = options;
    std::vector<double> ratios;
    for (int rep = 0; rep < kFitReps; ++rep) {
      options = standard;
      const double standard_ms = fit();
      setting.apply(options);
      ratios.push_back(fit() / standard_ms);
    }
    return ratios;
  }
};

}  // namespace

AccuracyKind gmmAccuracy() {
  return {"gmm",
          knobsOf(gmmSettings()),
          {"disk/near", "disk/far", "disk/oblique", "armour/near", "armour/far", "desert/near",
           "desert/far"},
          {"disk/far", "disk/oblique", "armour/far", "desert/far"},
          [](BenchRun& run, const std::vector<std::string>& scenes) {
            return std::unique_ptr<AccuracyEffect>(std::make_unique<GmmSweep>(
                run, "gmm", scenes, gmmSettingsOf(run, scenes), kGmmTruth));
          }};
}

}  // namespace glintmark
