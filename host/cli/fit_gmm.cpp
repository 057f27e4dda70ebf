// glintmark fit gmm: mip chains of Gaussian mixtures of normals, and how good they are.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "host/cli/fit_commands.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/core/unknown_name.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/mixture_picture.h"
#include "host/filter/interpolated_normals.h"
#include "host/filter/normal_map_generators.h"
#include "host/mixture/device_mixture_fit.h"
#include "host/mixture/mixture_cache.h"
#include "host/mixture/mixture_error.h"
#include "host/mixture/mixture_file.h"
#include "host/mixture/shared_mixture_fit.h"
#include "host/parallel/ranks.h"
#include "host/report/picture/image_io.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

// Finest levels whose error is measured, at how many places, and the deviation that both sides are
// widened by: that of a lobe of roughness 0.1. The closed form takes the square of the normals'
// number.
constexpr int kErrorLevels = 4;
constexpr int kErrorPoints = 200, kInterpolatedErrorPoints = 50;
constexpr double kErrorDeviation = 0.07;
constexpr int kPictureWidth_px = 1024;
constexpr int kPictureHeight_px = 256;  // of one strip, at most
constexpr int kMostIterations = 1000;
constexpr int kMostPasses = 16;
constexpr int kMostSeed = 1 << 30;
// In the order of MixtureSurface.
const std::vector<std::string> kSurfaces = {"interpolated", "texels"};

struct FitGmmCommand {
  std::string source, scene, material, output, picture, check,
      order = mixtureOrderName(MixtureOptions{}.order), surface = kSurfaces[0];
  std::string content = "auto", green = "up", on = "host";
  int size_px = NormalMapRecipe{}.size_px, seed = 1;
  double height_scale = 0;  // 0: the source's own default
  bool has_height_scale = false, has_lobes = false, refit = false;
  MixtureOptions options;
};

// The map and, once fitted or read, its mixtures.
struct Fitted {
  NormalMap map;
  NormalMixtures mixtures;
  bool measured_fit = true;  // in this run
};

void requireRange(const char* option, int value, int low, int high) {
  if (value < low || value > high) {
    throw Error(fmt::format("{} {} is not possible; it is {} to {}", option, value, low, high));
  }
}

int choice(const char* option, const std::string& text, const std::vector<std::string>& names) {
  requireKnownName(fmt::format("value of {}", option), text, names,
                   fmt::format("values of {}", option));
  return static_cast<int>(std::ranges::find(names, text) - names.begin());
}

void checkFitGmm(FitGmmCommand& command) {
  requireRange("--lobes", command.options.lobes, 1, kMaxLobes);
  requireRange("--iterations", command.options.max_iterations, 1, kMostIterations);
  requireRange("--passes", command.options.passes, 1, kMostPasses);
  requireRange("--size", command.size_px, 1, kMaxNormalMapSize_px);
  choice("--on", command.on, {"host", "device"});
  requireRange("--seed", command.seed, 0, kMostSeed);
  command.options.order = parseMixtureOrder(command.order);
  command.options.surface =
      static_cast<MixtureSurface>(choice("--surface", command.surface, kSurfaces));
  if (command.on == "device" && allRanks().size() > 1)
    throw Error("--on device fits on one device; start it without mpirun, or share --on host");
  requirePng(command.picture);
  if (allRanks().isFirst())
    announceOutputs({{"-o", command.output}, {"--picture", command.picture}});
}

// Asked before the map is made: of a file's its size is read first.
void requireRoomForFit(const NormalMap& map, const MixtureOptions& options) {
  const std::uint64_t bytes = normalMapBytes(map.width_px, map.height_px, true) +
                              mixtureFitBytes(map.width_px, map.height_px, options);
  const std::uint64_t free_bytes = freeMemoryBytes();
  if (free_bytes == 0 || bytes <= free_bytes) return;
  throw Error(
      fmt::format("a fit of {} lobes to map '{}' of {}x{} texels needs about {:.1f} GB of memory, "
                  "but {:.1f} GB "
                  "are free; choose fewer texels or --lobes",
                  options.lobes, map.name, map.width_px, map.height_px,
                  static_cast<double>(bytes) * 1e-9, static_cast<double>(free_bytes) * 1e-9));
}

bool isChosen(const FitGmmCommand& command, const Material& material) {
  return material.normal_map && (command.material.empty() || command.material == material.name);
}

// The map of the scene's chosen material, or of the first that has one; the lobes too, unless the
// command line says how many.
NormalMap sceneMap(const CommonOptions& common, FitGmmCommand& command) {
  const Scene scene = openScene(common, command.scene, [&](const Scene& planned) {
    const auto chosen = std::ranges::find_if(
        planned.materials, [&](const Material& material) { return isChosen(command, material); });
    if (chosen == planned.materials.end() || !command.check.empty()) return;
    MixtureOptions options = command.options;
    if (!command.has_lobes) options.lobes = chosen->normal_map->lobes;
    requireRoomForFit(*chosen->normal_map->map, options);
  });
  std::vector<std::string> mapped;
  for (const Material& material : scene.materials) {
    if (!material.normal_map) continue;
    mapped.push_back(material.name);
    if (!isChosen(command, material)) continue;
    if (!command.has_lobes) command.options.lobes = material.normal_map->lobes;
    return *material.normal_map->map;
  }
  if (mapped.empty()) throw Error(fmt::format("scene '{}' has no normal map", scene.name));
  throw Error(fmt::format("scene '{}' has no material '{}' with a normal map; it has {}",
                          scene.name, command.material, fmt::join(mapped, ", ")));
}

NormalMap loadMap(const CommonOptions& common, FitGmmCommand& command) {
  if (command.source.empty() == command.scene.empty()) {
    throw Error("fit gmm needs a map or a --scene, one of the two");
  }
  if (!command.scene.empty()) return sceneMap(common, command);
  NormalMapDecoding decoding;
  decoding.content =
      static_cast<MapContent>(choice("--content", command.content, {"auto", "normals", "heights"}));
  decoding.green = static_cast<GreenAxis>(choice("--green", command.green, {"up", "down"}));
  const std::vector<std::string> known = normalMapGenerators();
  if (std::ranges::find(known, command.source) != known.end()) {
    NormalMapRecipe recipe{.kind = command.source,
                           .size_px = command.size_px,
                           .seed = static_cast<std::uint32_t>(command.seed)};
    if (command.has_height_scale) recipe.height_scale = command.height_scale;
    if (command.check.empty())
      requireRoomForFit({recipe.kind, recipe.size_px, recipe.size_px, {}}, command.options);
    return generateNormalMap(recipe);
  }
  const std::string file = command.source.substr(0, command.source.rfind('#'));
  if (!std::filesystem::exists(command.source) && !std::filesystem::exists(file)) {
    throw Error(fmt::format("'{}' is neither an image file nor a generated map; generators are {}",
                            command.source, fmt::join(known, ", ")));
  }
  if (command.has_height_scale) decoding.height_scale = command.height_scale;
  const glm::ivec2 size = normalsSize(command.source);
  if (command.check.empty())
    requireRoomForFit({command.source, size.x, size.y, {}}, command.options);
  return readNormalMap(command.source, readNormals, decoding);
}

// Of all ranks: what the first has in its cache, or a fit that it puts there.
Fitted fitByRanks(const FitGmmCommand& command, NormalMap map,
                  const std::function<void(double)>& show) {
  const Ranks& ranks = allRanks();
  const DiskCache cache = DiskCache::fromEnvironment();
  const std::string key = mixtureKey(map, command.options);
  std::optional<NormalMixtures> known;
  if (ranks.isFirst() && !command.refit) known = loadMixtures(cache, key);
  const bool fits = !ranks.any(known.has_value());
  if (fits) known = fitMixturesShared(ranks, map, command.options, show);
  if (fits && !command.refit && ranks.isFirst()) storeMixtures(cache, key, *known);
  return {std::move(map), known ? std::move(*known) : NormalMixtures(), fits};
}

Fitted fitMap(const CommonOptions& common, const FitGmmCommand& command, NormalMap map) {
  const InterruptGuard guard;
  Progress progress(common.quiet);
  const auto show = [&](double share) {
    if (InterruptGuard::interrupted()) throw Interrupted("interrupted; nothing was written");
    progress.show(static_cast<int>(share * 100), 100, "% of the fit");
  };
  if (command.on == "device") {
    Device device = openDevice(common);
    ProgramCache cache(device);
    NormalMixtures mixtures =
        fitMixturesOnDevice(device, cache, chosenLanes(common, device), map, command.options, show);
    return {std::move(map), std::move(mixtures), true};
  }
  if (command.refit || allRanks().size() > 1) return fitByRanks(command, std::move(map), show);
  CachedMixtures cached =
      cachedNormalMixtures(map, command.options, DiskCache::fromEnvironment(), show);
  return {std::move(map), std::move(cached.mixtures), !cached.from_cache};
}

Fitted readFitted(const FitGmmCommand& command, NormalMap map) {
  NormalMixtures mixtures = parseMixtures(readFile(command.check), command.check);
  const MipTexture& layout = mixtures.moments.layout;
  if (static_cast<int>(layout.width) != map.width_px ||
      static_cast<int>(layout.height) != map.height_px) {
    throw Error(fmt::format("'{}' holds mixtures of a {}x{} map, but '{}' has {}x{} texels",
                            command.check, layout.width, layout.height, map.name, map.width_px,
                            map.height_px));
  }
  return {std::move(map), std::move(mixtures), false};
}

// Levels from the second on are held against what they were fitted to.
void printLevels(const Fitted& fitted, MixtureSurface surface) {
  const bool interpolated = surface == MixtureSurface::kInterpolated && canInterpolate(fitted.map);
  const NormalMap finer =
      interpolated ? interpolatedNormals(fitted.map, kSurfaceSamples) : fitted.map;
  TextTable table({"level", "texels", "EM steps", "converged", "log-likelihood", "misalignment",
                   "error at texels", "between"});
  const auto level_count = static_cast<int>(fitted.mixtures.levels.size());
  for (int level = 0; level < level_count; ++level) {
    const MixtureLevelReport& report = fitted.mixtures.levels[level];
    std::string at = "-", between = "-";
    if (level < kErrorLevels) {
      const bool between_texels = interpolated && level > 0;
      const InterpolationError error = measureInterpolation(
          between_texels ? finer : fitted.map, fitted.mixtures, level,
          between_texels ? kInterpolatedErrorPoints : kErrorPoints, kErrorDeviation, 1);
      at = fmt::format("{:.4f}", error.fitted), between = fmt::format("{:.4f}", error.interpolated);
    }
    table.addRow({std::to_string(level), fmt::format("{}x{}", report.width_px, report.height_px),
                  fmt::format("{:.1f}", report.mean_iterations),
                  fmt::format("{:.0f} %", 100 * report.converged_share),
                  fmt::format("{:.3f}", report.log_likelihood),
                  fmt::format("{:.4f}", measureMisalignment(fitted.mixtures, level)), at, between});
  }
  printText("{}", table.toString());
}

void printReport(const FitGmmCommand& command, const Fitted& fitted) {
  const NormalMixtures& mixtures = fitted.mixtures;
  fmt::print(
      "{} {}x{}: {} lobes a texel, {:.1f} MB, {}\n", fitted.map.name, fitted.map.width_px,
      fitted.map.height_px, mixtures.lobes,
      static_cast<double>(mixtures.moments.texels.size()) * sizeof(float4) * 1e-6,
      command.check.empty()
          ? fmt::format("{} in {:.2f} s", fitted.measured_fit ? "fitted" : "from the cache, fitted",
                        mixtures.fit_ms * 1e-3)
          : fmt::format("read from {}", command.check));
  printLevels(fitted, command.options.surface);
  double limited = 0, texels = 0;
  for (const MixtureLevelReport& report : mixtures.levels) {
    const double count = static_cast<double>(report.width_px) * report.height_px;
    limited += count * (1 - report.converged_share), texels += count;
  }
  printText("{:.1f} % of the texels stopped at the limit of EM steps\n", 100 * limited / texels);
}

// The mixtures and, below them, what the same texels get without neighbours.
void writeMixturePicture(const FitGmmCommand& command, const Fitted& fitted) {
  const int level = pictureLevel(fitted.mixtures, kPictureWidth_px);
  const int side =
      std::max(fitted.mixtures.moments.levelWidth(level) * fitted.mixtures.lobes,
               fitted.mixtures.moments.levelHeight(level) * kPictureWidth_px / kPictureHeight_px);
  const int texel_px = std::max(1, kPictureWidth_px / side);
  MixtureOptions alone = command.options;
  alone.lobes = fitted.mixtures.lobes;
  alone.order = MixtureOrder::kIndependent;
  const NormalMixtures unaligned =
      cachedNormalMixtures(fitted.map, alone, DiskCache::fromEnvironment()).mixtures;
  writePng(pictureColumn({mixturePicture(fitted.mixtures, level, texel_px, command.order),
                          mixturePicture(unaligned, level, texel_px, "independent")}),
           command.picture);
}

int runFitGmm(const CommonOptions& common, FitGmmCommand& command) {
  checkFitGmm(command);
  command.options.threads = common.threads;
  NormalMap map = loadMap(common, command);
  const Fitted fitted = command.check.empty() ? fitMap(common, command, std::move(map))
                                              : readFitted(command, std::move(map));
  if (!allRanks().isFirst()) return kExitDone;
  if (!command.output.empty()) writeFile(command.output, serializeMixtures(fitted.mixtures));
  if (!command.picture.empty()) writeMixturePicture(command, fitted);
  printReport(command, fitted);
  return kExitDone;
}

}  // namespace

void addFitGmmCommand(Command fit, CommandLine& line) {
  auto options = std::make_shared<FitGmmCommand>();
  Command command =
      fit.subcommand("gmm", "Mip chains of Gaussian mixtures of a map's normals, and their error");
  command
      .option(
          "map", options->source,
          fmt::format("Image of normals or heights, or {}", fmt::join(normalMapGenerators(), ", ")))
      .typeName("MAP");
  command.option("--scene", options->scene, "A scene's map instead, with --set as elsewhere");
  command.option("--material", options->material,
                 "Which of the scene's materials (default: the first with a map)");
  const CommandOption lobes = command.option(
      "--lobes", options->options.lobes, "Gaussians a texel, 1 to 8 (default: the scene's, or 4)");
  command.option("--order", options->order,
                 "colours, scanline (as published), independent (default: colours)");
  command.option("--surface", options->surface,
                 "interpolated: between texels too, as frames show it; texels: as published "
                 "(default: interpolated)");
  command.option("--iterations", options->options.max_iterations,
                 "Most EM steps of a texel in a pass (default: 4)");
  command.option("--passes", options->options.passes,
                 "Over all levels; from the second on finer texels count too (default: 2)");
  command.option("--size", options->size_px, "Texels a side of a generated map (default: 512)");
  command.option("--seed", options->seed, "Of a generated map (default: 1)");
  command.option("--content", options->content, "auto, normals, heights (default: auto)");
  command.option("--green", options->green,
                 "up or down: where green points in an image of normals (default: up)");
  const CommandOption height_scale = command.option(
      "--height-scale", options->height_scale,
      "Height of the value 1 in sides of the map (default: 1 generated, 0.05 images)");
  command.option("-o,--output", options->output, "The mixtures").typeName("FILE");
  command.option("--check", options->check, "Measure this file's mixtures; fit nothing")
      .typeName("FILE");
  command.option("--picture", options->picture, "Lobes of a level, with and without neighbours")
      .typeName("FILE.png");
  command.option("--on", options->on, "host or device, which fits anew each time (default: host)");
  command.flag("--refit", options->refit, "Do not look into the cache");
  command.footer(
      "Examples:\n"
      "  glintmark fit gmm disk --lobes 4 -o disk.mixtures --picture disk.png\n"
      "  glintmark fit gmm stone_normal.png --green down --passes 3\n"
      "  glintmark fit gmm height.exr --content heights --height-scale 0.1\n"
      "  glintmark fit gmm --scene armour --set material.gold.normal_map.size_px=1024\n"
      "  glintmark fit gmm disk --check disk.mixtures");
  command.callback([options, lobes, height_scale, &line] {
    options->has_lobes = lobes.given();
    options->has_height_scale = height_scale.given();
    line.shares_work = true;
    line.opens_device = true;
    line.action = [options, &line] { return runFitGmm(line.common, *options); };
  });
}

}  // namespace glintmark
