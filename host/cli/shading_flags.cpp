#include "host/cli/shading_flags.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/frame/effects.h"
#include "host/ocl/switches.h"

namespace glintmark {
namespace {

template <typename T>
std::string choiceHelp(const std::string& standard) {
  return fmt::format("{} (default: {})", listOf(namesOf<T>(), "or"), standard);
}

// Why a material's lobes are not widened by the mesh's curvature.
std::string uncurved(const KernelConfig& config) {
  if (config.glint) return "has microdetails";
  if (config.normal_map) return "has a normal map";
  return "is lit by area lights alone";
}

// Has the material a lobe that --round-lobes makes round?
bool canBeRound(const KernelConfig& config, const Material& material) {
  const float2 alpha = material.params.surface.alpha_g;
  const bool is_mapped = config.normal_map && (config.ltc_method == LtcMethod::kMixture ||
                                               config.ltc_method == LtcMethod::kCovariance);
  return config.ltc && alpha.x != alpha.y && !is_mapped;
}

// Has it one that a mixture of normals makes round unasked?
bool becomesRound(const KernelConfig& config, const Material& material) {
  const float2 alpha = material.params.surface.alpha_g;
  return config.ltc && config.normal_map && config.ltc_method == LtcMethod::kMixture &&
         !config.round_lobes && alpha.x != alpha.y;
}

}  // namespace

void ShadingFlags::add(Command& command, const std::string& name, std::string& value,
                       const std::string& help) {
  given_.push_back({name, command.option(name, value, help)});
}

void ShadingFlags::addGlintOptions(Command& command) {
  add(command, "--method", method_, methodHelp(method_));
  given_.push_back(
      {"--drawn-lights",
       command
           .option("--drawn-lights", drawn_lights_,
                   "Draws glints under so many lights of a pixel, all others as one (default: 0, "
                   "all)")
           .typeName("N")});
  add(command, "--light-cut", light_cut_,
      "How many cones may count as one where the lobe hardly tells them apart: " +
          choiceHelp<LightCut>(light_cut_));
}

void ShadingFlags::addSurfaceOptions(Command& command) {
  add(command, "--geometric-aa", geometric_aa_, choiceHelp<GeometricAa>(geometric_aa_));
  add(command, "--normal-method", normal_method_, choiceHelp<NormalMethod>(normal_method_));
  add(command, "--ltc-method", ltc_method_, choiceHelp<LtcMethod>(ltc_method_));
  given_.push_back(
      {"--round-lobes", command.flag("--round-lobes", round_lobes_,
                                     "Area lights see round lobes on anisotropic materials too")});
}

void ShadingFlags::apply(ShadingOptions& options) const {
  options.method = parseMethod(method_);
  options.normal_method = parseChoice<NormalMethod>(normal_method_, "normal method");
  options.ltc_method = parseChoice<LtcMethod>(ltc_method_, "area light method");
  options.drawn_lights = checkedDrawnLights(drawn_lights_);
  options.geometric_aa = parseChoice<GeometricAa>(geometric_aa_, "geometric antialiasing");
  options.round_lobes = round_lobes_;
  options.light_cut = parseChoice<LightCut>(light_cut_, "light cut");
}

bool ShadingFlags::isGiven(const std::string& name) const {
  return std::ranges::any_of(
      given_, [&](const Given& one) { return one.name == name && one.option.given(); });
}

std::vector<std::string> ShadingFlags::idle(const Scene& scene, const ShadingOptions& options,
                                            bool truth) const {
  std::vector<std::string> notes;
  if (truth) {
    for (const Given& one : given_)
      if (one.option.given())
        notes.push_back(one.name + " does nothing with --truth, which knows no methods");
    return notes;
  }
  std::vector<KernelConfig> configs;
  for (const Material& material : scene.materials)
    configs.push_back(configFor(material, scene, options, 1));
  const auto note = [&](const char* name, bool used, const std::string& what) {
    if (isGiven(name) && !used)
      notes.push_back(fmt::format("{} does nothing in scene {}, {}", name, scene.name, what));
  };
  const auto needs = [&](const char* name, bool KernelConfig::*effect, const std::string& what) {
    note(name, std::ranges::any_of(configs, effect), what);
  };
  const std::string no_glints =
      options.glints ? "where no material has glints" : "since --no-glints leaves none";
  needs("--method", &KernelConfig::glint, no_glints);
  needs("--drawn-lights", &KernelConfig::glint, no_glints);
  needs("--normal-method", &KernelConfig::normal_map, "where no material has a normal map");
  note("--ltc-method",
       std::ranges::any_of(configs,
                           [](const KernelConfig& one) { return one.ltc && one.normal_map; }),
       "where area lights shine on no normal map");
  bool can_be_round = false;
  for (std::size_t i = 0; i < configs.size(); ++i)
    can_be_round = can_be_round || canBeRound(configs[i], scene.materials[i]);
  note("--round-lobes", can_be_round, "where area lights see no stretched lobe");
  needs("--light-cut", &KernelConfig::light_cone, "which has no cones of light");
  for (std::size_t i = 0; i < configs.size(); ++i) {
    const std::string& material = scene.materials[i].name;
    if (options.geometric_aa != GeometricAa::kNone && configs[i].geometric_aa == GeometricAa::kNone)
      notes.push_back(fmt::format("--geometric-aa does nothing to material {}, which {}", material,
                                  uncurved(configs[i])));
    if (becomesRound(configs[i], scene.materials[i]))
      notes.push_back(fmt::format(
          "--ltc-method mixture has no stretched lobes: area lights see material {} round",
          material));
    if (options.light_cut != LightCut::kAll && configs[i].light_cone && configs[i].normal_map)
      notes.push_back(fmt::format(
          "--light-cut does nothing to material {}, whose normal map sees each cone", material));
  }
  return notes;
}

void ShadingFlags::noteIdle(const Scene& scene, const ShadingOptions& options, bool quiet,
                            bool truth) const {
  if (quiet) return;
  for (const std::string& note : idle(scene, options, truth))
    fmt::print(stderr, "note: {}\n", note);
}

}  // namespace glintmark
