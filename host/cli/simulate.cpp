// glintmark simulate: rays at a rough surface. [PAT18] "Using Brute Force Ray-Casting"
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <numbers>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/core/unknown_name.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/msbrdf/lobe_picture.h"
#include "host/parallel/ranks.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/folder_lock.h"
#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"
#include "host/simulate/shared_simulation.h"
#include "host/simulate/simulation.h"
#include "host/simulate/simulation_file.h"

namespace glintmark {
namespace {

constexpr double kSaveEvery_ns = 10e9;
const std::vector<std::string> kSurfaceNames = {"diffuse", "metal", "dielectric"};
const std::vector<std::string> kModelNames = {"heights", "smith"};

struct SimulateOptions {
  std::string surface = "diffuse", model = "heights";
  std::vector<double> alpha = {0.8};
  double rays = 1 << 24;
  double albedo = 1;
  std::string checkpoint, picture, csv;
  bool resume = false;
  bool ior_given = false, k_given = false, correlation_given = false;
  SimulationSettings settings;
};

// Throws Error for an option that would do nothing.
void refuseIdleOptions(const SimulateOptions& options, const SimulationSettings& settings) {
  if (options.correlation_given && settings.model == SurfaceModel::kSmith)
    throw Error(
        "--correlation is for --model heights; facets of Smith's theory have no heights that go "
        "together");
  if (options.ior_given && settings.kind == SurfaceKind::kDiffuse)
    throw Error("--ior is for metals and dielectrics; diffuse surfaces have --albedo");
  if (options.k_given && settings.kind != SurfaceKind::kMetal)
    throw Error("--k is for metals alone; add --surface metal");
  if (settings.f0 && (options.ior_given || options.k_given))
    throw Error("--f0 stands in place of --ior and --k; leave those out, or --f0");
}

SurfaceKind parseSurface(const std::string& name) {
  if (name == "diffuse") return SurfaceKind::kDiffuse;
  if (name == "metal") return SurfaceKind::kMetal;
  if (name == "dielectric") return SurfaceKind::kDielectric;
  throw Error(unknownName("surface", name, kSurfaceNames));
}

SurfaceModel parseModel(const std::string& name) {
  if (name == "heights") return SurfaceModel::kHeights;
  if (name == "smith") return SurfaceModel::kSmith;
  throw Error(unknownName("model", name, kModelNames));
}

SimulationSettings makeSettings(const SimulateOptions& options) {
  SimulationSettings settings = options.settings;
  settings.kind = parseSurface(options.surface);
  settings.model = parseModel(options.model);
  settings.alpha = {options.alpha.front(), options.alpha.back()};
  if (!(options.rays >= 0 && options.rays <= 281474976710656.0))
    throw Error(fmt::format("--rays {} is not from 1 to 2^48", options.rays));
  settings.rays = static_cast<std::uint64_t>(options.rays);
  if (!(options.albedo >= 0 && options.albedo <= 1))
    throw Error(fmt::format("--albedo {} is not from 0 to 1", options.albedo));
  if (options.albedo < 1 && settings.kind != SurfaceKind::kDiffuse)
    throw Error("--albedo is for diffuse surfaces; metals and dielectrics follow Fresnel");
  refuseIdleOptions(options, settings);
  if (options.resume && options.checkpoint.empty())
    throw Error("--resume needs the file to carry on from: add --checkpoint FILE");
  validate(settings);
  return settings;
}

std::string keptText(const Simulation& kept, const SimulateOptions& options) {
  if (options.checkpoint.empty()) return "nothing is kept without --checkpoint FILE";
  return fmt::format("{} of {} rays are kept in {}, --resume carries on", kept.rays_done,
                     kept.settings.rays, options.checkpoint);
}

// Casts what is missing by all ranks, with checkpoints now and then and after Ctrl-C.
SharedTime::Spent castRays(SharedSimulation& shared, const SimulateOptions& options, bool quiet) {
  const Ranks& ranks = allRanks();
  Progress progress(quiet);
  ranks.any(false);  // all have compiled
  const auto save = [&] {
    shared.collect();
    if (ranks.isFirst() && !options.checkpoint.empty())
      writeFile(options.checkpoint, packSimulation(shared.collected()));
  };
  const std::uint64_t total = shared.collected().settings.rays;
  double saved_ns = 0;
  const SharedTime time(ranks);
  try {
    while (!shared.isDone()) {
      // By the first rank's clock, since all have to bring their counts together.
      const bool due = time.elapsedNs() - saved_ns > kSaveEvery_ns || InterruptGuard::endIsNear();
      const auto [stop, collect] =
          shared.advance({InterruptGuard::interrupted(), due && ranks.isFirst()});
      progress.show(static_cast<int>(100 * shared.cast() / total), 100, "per cent of the rays");
      if (shared.isDone() || !(stop || collect)) continue;
      save();
      saved_ns = time.elapsedNs();
      if (stop) throw Interrupted("interrupted; " + keptText(shared.collected(), options));
    }
    save();
  } catch (const RankSilent&) {
    progress.clear();
    throw Interrupted("interrupted, and a rank did not answer; " +
                      keptText(shared.collected(), options));
  }
  return time.spent();
}

// Where the energy went. A diffuse microfacet of albedo a keeps a of what meets it, so an order's
// energy is its counts times a^order and the rest was absorbed on the way.
std::string energyTable(const Simulation& simulation, double albedo) {
  const bool refracts = simulation.settings.kind == SurfaceKind::kDielectric;
  const auto rays = static_cast<double>(simulation.rays_done);
  std::vector<std::string> header = {"order", "energy above", "standard error"};
  if (refracts) header.insert(header.end(), {"energy below"});
  TextTable table(header);
  double above = 0, below = 0;
  for (int order = 1; order <= simulation.settings.orders; ++order) {
    const double share = orderEnergy(simulation, order);
    const double weight = std::pow(albedo, order);
    std::vector<std::string> row = {
        fmt::format("{}", order), fmt::format("{:.6f}", weight * share),
        fmt::format("{:.1e}", weight * std::sqrt(share * (1 - share) / rays))};
    above += weight * share;
    if (refracts) {
      const double through = static_cast<double>(simulation.left(1, order)) / rays;
      row.push_back(fmt::format("{:.6f}", through));
      below += through;
    }
    table.addRow(row);
  }
  const double left = std::pow(albedo, simulation.settings.orders) *
                      static_cast<double>(simulation.leftOver() + simulation.gaveUp()) / rays;
  const double absorbed = simulation.settings.kind == SurfaceKind::kDiffuse
                              ? std::max(1 - above - left, 0.0)
                              : static_cast<double>(simulation.absorbed()) / rays;
  return table.toString() +
         fmt::format(
             "\nescaped {:.6f}, absorbed {:.6f}, left over after order {} {:.6f}\n"
             "counted {:.9f} of the rays\n",
             above + below, absorbed, simulation.settings.orders, left, simulation.balance());
}

std::string energyCsv(const Simulation& simulation, double albedo) {
  std::string text = "order,above,below\n";
  for (int order = 1; order <= simulation.settings.orders; ++order)
    text += fmt::format(
        "{},{},{}\n", order, orderEnergy(simulation, order, albedo),
        static_cast<double>(simulation.left(1, order)) / static_cast<double>(simulation.rays_done));
  return text;
}

std::string slopesText(const Simulator& simulator, const SimulationSettings& settings) {
  const SlopeMoments m =
      slopeMoments(simulator.surface().readCounts(), simulator.surface().countHeight());
  const glm::dvec2 nominal = 0.5 * settings.alpha * settings.alpha;
  return fmt::format(
      "slope variance along x and y: {:.6f} and {:.6f} nominal,\n{:.6f} and {:.6f} effective in "
      "the last surface\n",
      nominal.x, nominal.y, 2 * nominal.x * m.variance_x, 2 * nominal.y * m.variance_y);
}

// What of the files belongs to the first rank alone: whether they can be written, and the lock.
std::unique_ptr<FolderLock> checkFiles(const SimulateOptions& options) {
  announceOutputs(
      {{"--checkpoint", options.checkpoint}, {"-o", options.picture}, {"--csv", options.csv}});
  if (options.checkpoint.empty()) return nullptr;
  return std::make_unique<FolderLock>(options.checkpoint + ".lock", options.checkpoint,
                                      "choose another --checkpoint");
}

// Of all ranks: what the checkpoint holds. Only the first has its counts.
Simulation simulationToCarryOn(const SimulationSettings& settings, const SimulateOptions& options) {
  const Ranks& ranks = allRanks();
  Simulation simulation{settings, 0, {}};
  if (ranks.isFirst() && options.resume && std::filesystem::exists(options.checkpoint))
    simulation = unpackSimulation(readFile(options.checkpoint, FileRole::kOwn), settings,
                                  options.checkpoint);
  simulation.rays_done = std::stoull(ranks.fromFirst(std::to_string(simulation.rays_done)));
  return simulation;
}

std::string castText(const Simulator& simulator, const SharedSimulation& shared,
                     const SharedTime::Spent& cast, std::uint64_t rays) {
  const Ranks& ranks = allRanks();
  const SimulationSettings& settings = shared.collected().settings;
  std::string slopes;
  if (settings.model == SurfaceModel::kHeights && shared.castLast())
    slopes = slopesText(simulator, settings);
  std::string text;
  for (const std::string& one : ranks.gather(slopes)) text += one;
  // One process says what its kernels do; ranks, what they do together.
  const bool launched_here = &ranks != &aloneRanks();
  const double seconds =
      launched_here ? cast.wall_s : (simulator.traceNs() + simulator.surfaceNs()) * 1e-9;
  text += fmt::format("{:.2f} s, {:.2f} million rays per second", seconds,
                      static_cast<double>(rays) / seconds * 1e-6);
  if (launched_here)
    text += fmt::format(" by {} ranks, which waited for each other {:.1f} % of that time",
                        ranks.size(), 100 * cast.waiting);
  return text + "\n";
}

void writeResults(const Simulation& simulation, const SimulateOptions& options) {
  if (!options.picture.empty()) writePng(histogramPicture(simulation), options.picture);
  if (!options.csv.empty()) writeFile(options.csv, energyCsv(simulation, options.albedo));
}

int runSimulate(const CommandLine& line, const SimulateOptions& options) {
  const SimulationSettings settings = makeSettings(options);
  if (!options.picture.empty() && requireImageExtension(options.picture) != ".png")
    throw Error(fmt::format("--output '{}' must end in .png", options.picture));
  const bool first = allRanks().isFirst();
  const InterruptGuard guard;  // before there is a lock file to be left behind
  const std::unique_ptr<FolderLock> lock = first ? checkFiles(options) : nullptr;
  const Simulation begun = simulationToCarryOn(settings, options);

  Device device = openDevice(line.common);
  ProgramCache cache(device);
  Simulator simulator(device, cache, chosenLanes(line.common, device));
  SharedSimulation shared(allRanks(), simulator, begun);
  const SharedTime::Spent cast = castRays(shared, options, line.common.quiet);
  std::string how;
  if (shared.cast() > begun.rays_done)
    how = castText(simulator, shared, cast, shared.cast() - begun.rays_done);
  if (!first) return kExitDone;

  const Simulation& simulation = shared.collected();
  printText("{}, {} rays\n\n{}{}", describeSettings(settings), simulation.rays_done,
            energyTable(simulation, options.albedo), how);
  if (simulation.gaveUp() > 0)
    printText("{} rays met the limit of {} steps and count as left over\n", simulation.gaveUp(),
              HF_MOST_STEPS);
  writeResults(simulation, options);
  return simulation.balance() == 1 ? kExitDone : kExitCheckFailed;
}

}  // namespace

void addSimulateCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<SimulateOptions>();
  SimulationSettings& s = options->settings;
  Command command =
      app.subcommand("simulate", "Casts rays at a rough surface and counts what leaves");
  command.option("--surface", options->surface, "diffuse, metal or dielectric").typeName("KIND");
  command.option("--model", options->model, "heights, or smith: facets without (heights)")
      .typeName("MODEL");
  command.option("--alpha", options->alpha, "Beckmann roughness, one or along x and y (0.8)")
      .values(1, 2);
  command.option("--incidence", s.incidence_deg, "Of the light, degrees from the normal (45)");
  command.option("--azimuth", s.azimuth_deg, "Of the light, degrees from x (0)");
  const CommandOption ior =
      command.option("--ior", s.index_n, "Index of refraction, of metals its real part (1.5)");
  const CommandOption k = command.option("--k", s.index_k, "Imaginary part of a metal's index (0)");
  command.option("--f0", s.f0, "Of metals, in place of an index: reflectance straight on");
  command.option("--tint", s.tint, "At 82 degrees, times what Schlick's term has with f0 (1)");
  command.option("--albedo", options->albedo, "Of diffuse microfacets (1)");
  command.option("--orders", s.orders, "Bounces that rays are followed for, 1 to 6 (4)");
  command.option("--rays", options->rays, "How many, as in 500e6 (2^24)");
  command.option("--seed", s.seed, "Of surfaces and rays (1)");
  const CommandOption correlation = command.option(
      "--correlation", s.correlation_texels, "Correlation length of the heights in texels (3)");
  command.option("--checkpoint", options->checkpoint, "Keeps what is done in this file")
      .typeName("FILE");
  command.flag("--resume", options->resume, "Carries on from the checkpoint, if there is one");
  command.option("-o,--output", options->picture, "Picture of where the orders leave to")
      .typeName("FILE.png");
  command.option("--csv", options->csv, "Energy per order").typeName("FILE");
  command.footer(
      "Examples:\n"
      "  glintmark simulate --alpha 0.8 --incidence 60 -o orders.png\n"
      "  glintmark simulate --surface metal --ior 0.2 --k 3.9 --alpha 0.5 0.1\n"
      "  glintmark simulate --rays 500e6 --checkpoint run.sim --resume");
  command.callback([options, ior, k, correlation, &line] {
    options->ior_given = ior.given();
    options->k_given = k.given();
    options->correlation_given = correlation.given();
    line.shares_work = true;
    line.opens_device = true;
    line.action = [options, &line] { return runSimulate(line, *options); };
  });
}

}  // namespace glintmark
