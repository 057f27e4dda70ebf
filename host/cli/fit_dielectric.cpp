// glintmark fit dielectric: lobes of what rough glass reflects and lets through, order by order.
// Nothing shades with them yet.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/cli/fit_commands.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/msbrdf/lobe_picture.h"
#include "host/fit/lobe_fit.h"
#include "host/parallel/ranks.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"
#include "host/simulate/shared_simulation.h"

namespace glintmark {
namespace {

constexpr double kGlassAlphas[] = {0.24, 0.43, 0.62, 0.81, 1.0};
constexpr double kGlassIncidences_deg[] = {0, 20, 40, 60, 80};
constexpr int kOrders = 4, kShownOrders = 3;
constexpr double kShownAlpha = 0.43, kShownIncidence_deg = 60;
constexpr const char* kSides[] = {"reflected", "transmitted"};
constexpr double kLeastGlassRays = 1000, kMostGlassRays = 1e12;

struct FitDielectricOptions {
  std::string folder = "results/latest", picture;
  double rays = 1 << 20, index = 1.5;
};

// One order of what leaves on a side.
struct SideLobe {
  double incidence_deg = 0;
  int side = 0;
  LobeData data;
  FreeLobe lobe;
};

SideLobe fitSide(const Simulation& simulation, int side, int order) {
  const SimulationSettings& s = simulation.settings;
  SideLobe fitted{s.incidence_deg, side, makeLobeData(simulation, order, side), {}};
  // The mirrored or the refracted direction, away from the light; further orders spread about the
  // normal.
  const double sine = std::sin(glm::radians(s.incidence_deg)) / (side == 1 ? s.index_n : 1.0);
  const double deviation_rad = order == 1 ? -std::asin(std::min(sine, 0.9)) : 0;
  const double exponent = order == 1 ? 2 / (s.alpha.x * s.alpha.x) : 1;
  fitted.lobe = fitLobe(fitted.data, false, deviation_rad, exponent);
  return fitted;
}

std::vector<SimulationSettings> dielectricRuns(const FitDielectricOptions& options) {
  std::vector<SimulationSettings> runs;
  for (const double alpha : kGlassAlphas)
    for (const double incidence_deg : kGlassIncidences_deg) {
      SimulationSettings s;
      s.kind = SurfaceKind::kDielectric;
      s.index_n = options.index;
      s.alpha = glm::dvec2(alpha);
      s.incidence_deg = incidence_deg;
      s.orders = kOrders;
      s.rays = static_cast<std::uint64_t>(options.rays);
      s.seed = static_cast<std::uint32_t>(runs.size() + 1);
      runs.push_back(s);
    }
  return runs;
}

std::string lobesCsv(const std::vector<SideLobe>& lobes) {
  std::string text =
      "alpha,incidence_deg,side,order,share,scale,exponent,flattening,deviation_rad,error\n";
  for (const SideLobe& l : lobes)
    text +=
        fmt::format("{:.2f},{:.0f},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", l.data.alpha,
                    l.incidence_deg, kSides[l.side], l.data.order, l.data.share, l.lobe.scale,
                    l.lobe.exponent, l.lobe.flattening, l.lobe.deviation_rad, l.lobe.error);
  return text;
}

// Means over incidences: the share of the light, and the free lobe's error.
std::string lobesTable(const std::vector<SideLobe>& lobes, double index) {
  std::vector<std::string> header = {fmt::format("n {}: alpha", index), "side"};
  for (int order = 1; order <= kShownOrders; ++order) {
    header.push_back(fmt::format("share of order {}", order));
    header.emplace_back("error");
  }
  TextTable table(header);
  for (const double alpha : kGlassAlphas)
    for (const int side : {0, 1}) {
      std::vector<std::string> row = {fmt::format("{:.2f}", alpha), kSides[side]};
      for (int order = 1; order <= kShownOrders; ++order) {
        double share = 0, error = 0;
        for (const SideLobe& l : lobes) {
          if (l.data.alpha != alpha || l.side != side || l.data.order != order) continue;
          share += l.data.share / static_cast<double>(std::size(kGlassIncidences_deg));
          error += l.lobe.error / static_cast<double>(std::size(kGlassIncidences_deg));
        }
        row.push_back(fmt::format("{:.4f}", share));
        row.push_back(fmt::format("{:.3f}", error));
      }
      table.addRow(row);
    }
  return table.toString();
}

// Simulated lobes of two orders on both sides, and the free lobes below them.
Image lobesPicture(const std::vector<SideLobe>& lobes) {
  constexpr int kDrawnOrders = 2, kColumns = 2 * kDrawnOrders;
  std::vector<LobeDisc> simulated, fitted;
  for (const SideLobe& l : lobes) {
    if (l.data.alpha != kShownAlpha || l.incidence_deg != kShownIncidence_deg ||
        l.data.order > kDrawnOrders)
      continue;
    LobeDisc disc;
    disc.caption = fmt::format("{}, order {}", kSides[l.side], l.data.order);
    disc.note = fmt::format("{:.2f} % of the light", 100 * l.data.share);
    disc.most = *std::ranges::max_element(l.data.energy);
    disc.compass = true;
    disc.light_cosine = l.data.mu_in;
    disc.value = [&l](double cosine, double azimuth) {
      return cellEnergy(l.data, cosine, azimuth);
    };
    simulated.push_back(disc);
    disc.caption = "free lobe";
    disc.note = fmt::format("error {:.3f}", l.lobe.error);
    disc.value = [&l](double cosine, double azimuth) {
      return freeLobeEnergy(l.lobe, l.data.alpha, l.data.mu_in, cosine, azimuth);
    };
    fitted.push_back(disc);
  }
  simulated.insert(simulated.end(), fitted.begin(), fitted.end());
  return lobePicture(simulated, kColumns);
}

void checkFitDielectric(const FitDielectricOptions& options) {
  if (!(options.rays >= kLeastGlassRays && options.rays <= kMostGlassRays))
    throw Error(fmt::format("--rays {} is not possible; it must be {:g} to {:g}", options.rays,
                            kLeastGlassRays, kMostGlassRays));
  for (const SimulationSettings& run : dielectricRuns(options)) validate(run);
  requirePng(options.picture);
  if (!allRanks().isFirst()) return;
  requireWritableFolder(options.folder);
  const std::filesystem::path folder = options.folder;
  announceOutputs({{"--picture", options.picture},
                   {"-o", (folder / "dielectric_lobes.csv").string()},
                   {"-o", (folder / "dielectric_lobes.txt").string()}});
}

int runFitDielectric(const CommandLine& line, const FitDielectricOptions& options) {
  checkFitDielectric(options);
  const std::filesystem::path folder = options.folder;
  const InterruptGuard guard;
  Device device = openDevice(line.common);
  ProgramCache cache(device);
  Simulator simulator(device, cache, chosenLanes(line.common, device));
  Progress progress(line.common.quiet);
  std::vector<SideLobe> lobes;
  int done = 0;
  const std::vector<SimulationSettings> runs = dielectricRuns(options);
  for (const SimulationSettings& run : runs) {
    progress.show(done++, static_cast<int>(runs.size()), "dielectric surfaces");
    const auto stop = [] {
      if (InterruptGuard::interrupted()) throw Interrupted("interrupted; nothing is written");
    };
    const Simulation simulation = simulateShared(allRanks(), simulator, {run}, stop).front();
    if (!allRanks().isFirst()) continue;
    if (simulation.balance() != 1) throw Error("the simulation lost rays");
    for (const int side : {0, 1})
      for (int order = 1; order <= kOrders; ++order)
        lobes.push_back(fitSide(simulation, side, order));
  }
  progress.clear();
  if (!allRanks().isFirst()) return kExitDone;
  const std::string table = lobesTable(lobes, options.index);
  writeFile(folder / "dielectric_lobes.csv", lobesCsv(lobes));
  writeFile(folder / "dielectric_lobes.txt", table);
  if (!options.picture.empty()) writePng(lobesPicture(lobes), options.picture);
  printText("{}\nmeans over incidences 0, 20, 40, 60 and 80 degrees; written to {}\n", table,
            (folder / "dielectric_lobes.csv").string());
  return kExitDone;
}

}  // namespace

void addFitDielectricCommand(Command fit, CommandLine& line) {
  auto options = std::make_shared<FitDielectricOptions>();
  Command command = fit.subcommand(
      "dielectric",
      "Lobes of what rough glass reflects and lets through; nothing shades with them");
  command.option("-o,--output", options->folder, "Tables (results/latest)").typeName("FOLDER");
  command.option("--ior", options->index, "Index of refraction (1.5)");
  command.option("--rays", options->rays, "Rays per roughness and incidence (2^20)");
  command.option("--picture", options->picture, "Lobes at roughness 0.43, light at 60 degrees")
      .typeName("FILE.png");
  command.footer(
      "Examples:\n"
      "  glintmark fit dielectric --picture lobes.png\n"
      "  glintmark fit dielectric --ior 2.4 --rays 4e6");
  command.callback([options, &line] {
    line.shares_work = true;
    line.opens_device = true;
    line.action = [options, &line] { return runFitDielectric(line, *options); };
  });
}

}  // namespace glintmark
