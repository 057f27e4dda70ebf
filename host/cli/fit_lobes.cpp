// glintmark fit lobes: simulations over roughness and incidence, and what is fitted to them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "host/cli/fit_commands.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/core/stopwatch.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/msbrdf/lobe_report.h"
#include "host/parallel/ranks.h"
#include "host/reference/microfacet.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {
namespace {

// [PAT18] names no grid; its figures are at 0.05 + 0.19 k. Every second value here is one of them.
constexpr int kAlphas = 11;
constexpr double kFirstAlpha = 0.05, kLastAlpha = 1;
constexpr double kIncidences_deg[] = {0, 10, 20, 30, 40, 50, 60, 70, 80, 85};
constexpr double kLeastRays = 1000, kMostRays = 1e12;
constexpr double kRaysPerMirrorSurface = 1 << 14, kMostMirrorSurfaces = 8;
constexpr int kMirrorAlphas = 18;  // 1/64, 1/32, then multiples of 1/16
constexpr int kMirrorNodes = 33;   // of the warped cosine, from 0 to 1

struct FitLobesOptions {
  std::string folder = "results/latest", data, picture;
  double rays = 1 << 21, mirror_rays = 1 << 17;
};

std::filesystem::path dataFile(const FitLobesOptions& options) {
  return options.data.empty() ? std::filesystem::path(options.folder) / "multiscatter.json"
                              : std::filesystem::path(options.data);
}

// A FittedLobe as ranks share it.
struct LobeNumbers {
  double alpha = 0, mu_in = 0, order = 0, share = 0;
  std::array<double, LobeData::kCosines * LobeData::kAzimuths> energy{};
  FreeLobe lobe{};
  double error_unmasked = 0;
};

// Order 0, all orders together, is not fitted to.
LobeNumbers fitOrder(const Simulation& simulation, int order) {
  const LobeData data = makeLobeData(simulation, order);
  LobeNumbers numbers{.alpha = data.alpha,
                      .mu_in = data.mu_in,
                      .order = static_cast<double>(data.order),
                      .share = data.share};
  std::ranges::copy(data.energy, numbers.energy.begin());
  if (order == 0) return numbers;
  numbers.lobe = fitLobe(data);
  numbers.error_unmasked = fitLobe(data, false).error;
  return numbers;
}

FittedLobe fromNumbers(const LobeNumbers& numbers) {
  LobeData data{.alpha = numbers.alpha,
                .mu_in = numbers.mu_in,
                .order = static_cast<int>(numbers.order),
                .energy = {numbers.energy.begin(), numbers.energy.end()},
                .share = numbers.share};
  return {std::move(data), numbers.lobe, numbers.error_unmasked};
}

class LobeFitRun {
 public:
  LobeFitRun(const CommandLine& line, const FitLobesOptions& options)
      : options_(options),
        device_(openDevice(line.common)),
        cache_(device_),
        simulator_(device_, cache_, chosenLanes(line.common, device_)),
        progress_(line.common.quiet) {}
  int run();

 private:
  Simulation simulate(const SimulationSettings& settings, std::size_t index, const char* what);
  std::vector<SimulationSettings> diffuseRuns() const;
  std::size_t diffuseCount() const { return kAlphas * std::size(kIncidences_deg); }
  void simulateDiffuse();
  int mirrorSurfaces() const;
  std::vector<double> simulateMirrors(const std::vector<SimulationSettings>& runs);
  void makeMirror();
  std::string tables() const;

  const Ranks& ranks_ = allRanks();
  const FitLobesOptions& options_;
  Device device_;
  ProgramCache cache_;
  Simulator simulator_;
  Progress progress_;
  LobeFits fits_;
};

// Run `index` of all; a run's seed is the number behind.
Simulation LobeFitRun::simulate(const SimulationSettings& settings, std::size_t index,
                                const char* what) {
  if (InterruptGuard::interrupted()) throw Interrupted("interrupted; nothing is written");
  const std::size_t total =
      diffuseCount() +
      static_cast<std::size_t>(kMirrorAlphas * (kMirrorNodes - 1) * mirrorSurfaces());
  progress_.show(static_cast<int>(index), static_cast<int>(total), what);
  SimulationSettings seeded = settings;
  seeded.seed = static_cast<std::uint32_t>(index + 1);
  return simulator_.run(seeded);
}

std::vector<SimulationSettings> LobeFitRun::diffuseRuns() const {
  std::vector<SimulationSettings> runs;
  for (const double alpha : fits_.alphas)
    for (const double incidence_deg : fits_.incidences_deg) {
      SimulationSettings s;
      s.alpha = glm::dvec2(alpha);
      s.incidence_deg = incidence_deg;
      s.rays = static_cast<std::uint64_t>(options_.rays);
      runs.push_back(s);
    }
  return runs;
}

// Each rank simulates some and fits to them; afterwards all have all.
void LobeFitRun::simulateDiffuse() {
  fits_.incidences_deg.assign(std::begin(kIncidences_deg), std::end(kIncidences_deg));
  for (int i = 0; i < kAlphas; ++i)
    fits_.alphas.push_back(kFirstAlpha + (kLastAlpha - kFirstAlpha) * i / (kAlphas - 1));
  const std::vector<SimulationSettings> runs = diffuseRuns();
  const auto orders = static_cast<std::size_t>(SimulationSettings().orders), row = orders + 1;
  std::vector<LobeNumbers> numbers(runs.size() * row);  // of orders 1 on, then of all together
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!ranks_.makes(i)) continue;
    const Simulation simulation = simulate(runs[i], i, "diffuse surfaces");
    for (std::size_t order = 0; order <= orders; ++order)
      numbers[i * row + (order + orders) % row] = fitOrder(simulation, static_cast<int>(order));
  }
  shareRows(ranks_, std::span(numbers), row);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    FittedLobe fitted = fromNumbers(numbers[i]);
    if (i % row == orders)
      fits_.totals.push_back(std::move(fitted.data));
    else
      fits_.lobes.push_back(std::move(fitted));
  }
}

// Surfaces differ by half a percent of the energy, more than the rays' counting error.
int LobeFitRun::mirrorSurfaces() const {
  return static_cast<int>(
      std::clamp(options_.mirror_rays / kRaysPerMirrorSurface, 1.0, kMostMirrorSurfaces));
}

SimulationSettings mirrorRun(double alpha, double mu, double rays) {
  SimulationSettings s;
  s.kind = SurfaceKind::kMetal;
  s.index_n = 0.05;  // with k this large the Fresnel term is 1 to six digits
  s.index_k = 1000;
  s.alpha = glm::dvec2(alpha);
  s.incidence_deg = glm::degrees(std::acos(std::min(mu, 1.0)));
  s.orders = 1;
  s.rays = static_cast<std::uint64_t>(rays);
  return s;
}

// The energy that is reflected in each of the runs, a mean over surfaces. Ranks share them.
std::vector<double> LobeFitRun::simulateMirrors(const std::vector<SimulationSettings>& runs) {
  const auto surfaces = static_cast<std::size_t>(mirrorSurfaces());
  std::vector<double> energies(runs.size() * surfaces);
  for (std::size_t i = 0; i < energies.size(); ++i)
    if (ranks_.makes(i))
      energies[i] = orderEnergy(simulate(runs[i / surfaces], diffuseCount() + i, "mirrors"), 1);
  shareRows(ranks_, std::span(energies), 1);
  std::vector<double> means(runs.size(), 0);
  for (std::size_t i = 0; i < energies.size(); ++i) means[i / surfaces] += energies[i];
  for (double& mean : means) mean /= static_cast<double>(surfaces);
  return means;
}

void LobeFitRun::makeMirror() {
  MirrorAlbedo& table = fits_.data.mirror;
  for (int j = 0; j < kMirrorNodes; ++j)
    table.warped.push_back(static_cast<double>(j) / (kMirrorNodes - 1));
  std::vector<SimulationSettings> runs;
  for (int i = 0; i < kMirrorAlphas; ++i) {
    const double alpha = i < 2 ? (i + 1) / 64.0 : (i - 1) / 16.0;
    table.alphas.push_back(alpha);
    for (const double t : table.warped)
      if (const double mu = MirrorAlbedo::cosine(alpha, t); mu > 0)
        runs.push_back(mirrorRun(alpha, mu, options_.mirror_rays / mirrorSurfaces()));
  }
  const std::vector<double> energies = simulateMirrors(runs);
  auto energy = energies.begin();
  for (const double alpha : table.alphas)
    for (const double t : table.warped) {
      const double mu = MirrorAlbedo::cosine(alpha, t);
      // At the horizon a surface shows its peaks only, and nothing is lost.
      table.simulated.push_back(mu > 0 ? *energy++ : 1);
      const double lobe = reference::microfacetAlbedo(reference::Ndf::kBeckmann, mu, alpha,
                                                      reference::SmithForm::kRational);
      table.lobe.push_back(mu > 0 ? std::min(lobe, 1.0) : 1);
    }
}

std::string LobeFitRun::tables() const {
  double masked = 0, unmasked = 0;
  for (const FittedLobe& f : fits_.lobes) {
    if (f.data.order != 2) continue;
    const auto error = [&f](const LobePolynomials& set) {
      const Lobe lobe = lobeAt(set, f.data.mu_in, f.data.alpha);
      return lobeError(f.data, [&lobe](double cosine, double) { return lobeEnergy(lobe, cosine); });
    };
    masked += error(fits_.masked);
    unmasked += error(fits_.data.refit);
  }
  const double count = static_cast<double>(fits_.alphas.size() * fits_.incidences_deg.size());
  return lobeErrorTable(fits_, 2) + "\n" + lobeErrorTable(fits_, 3) + "\n" +
         coefficientTable(fits_) +
         fmt::format(
             "\nmasking in the polynomials: m = {:.3f}, mean error of order 2 {:.4f} "
             "({:.4f} without)\n\n",
             fits_.masked.masking, masked / count, unmasked / count) +
         eonTable(fits_) +
         fmt::format("\nEON's roughness r = {:.4f} alpha^2 / (alpha^2 + {:.4f})\n\n",
                     fits_.data.eon.top, fits_.data.eon.knee) +
         mirrorTable(fits_);
}

int LobeFitRun::run() {
  const std::filesystem::path folder = options_.folder;
  const std::filesystem::path data = dataFile(options_);
  const InterruptGuard guard;
  const Stopwatch watch;
  simulateDiffuse();
  const double diffuse_s = watch.elapsedNs() * 1e-9;
  makeMirror();
  progress_.clear();
  if (!ranks_.isFirst()) return kExitDone;
  std::vector<LobeData> all;
  for (const FittedLobe& f : fits_.lobes) all.push_back(f.data);
  const Stopwatch fit_watch;
  fits_.data.refit = fitPolynomials(all);
  fits_.masked = fitPolynomials(all, true);
  fits_.data.eon = fitEonRoughness(fits_.totals);
  fits_.data.fitted = fitScatter(all, fits_.totals);
  const double polynomials_s = fit_watch.elapsedNs() * 1e-9;
  fits_.data.source = fmt::format(
      "glintmark fit lobes: {} rays each at {} roughnesses and {} incidences, mirror: {} rays each",
      options_.rays, kAlphas, std::size(kIncidences_deg), options_.mirror_rays);
  const std::string table = tables();
  writeFile(data, toJson(fits_.data));
  writeFile(folder / "free_lobes.csv", freeLobesCsv(fits_));
  writeFile(folder / "lobe_errors.txt", table);
  writePng(residualDiscs(fits_), folder / "lobe_residuals.png");
  if (!options_.picture.empty()) writePng(residualPicture(fits_), options_.picture);
  printText(
      "{}\nsimulations and lobes {:.1f} s, polynomials {:.2f} s, all {:.1f} s; written to {}\n",
      table, diffuse_s, polynomials_s, watch.elapsedNs() * 1e-9, data.string());
  return kExitDone;
}

void checkFitLobes(const FitLobesOptions& options) {
  for (const auto& [name, rays] :
       {std::pair("--rays", options.rays), std::pair("--mirror-rays", options.mirror_rays)})
    if (!(rays >= kLeastRays && rays <= kMostRays))
      throw Error(fmt::format("{} {} is not possible; it must be {:g} to {:g}", name, rays,
                              kLeastRays, kMostRays));
  requirePng(options.picture);
  if (!allRanks().isFirst()) return;
  requireWritableFolder(options.folder);
  const std::filesystem::path folder = options.folder;
  announceOutputs({{"--picture", options.picture},
                   {"--data", dataFile(options).string()},
                   {"-o", (folder / "free_lobes.csv").string()},
                   {"-o", (folder / "lobe_errors.txt").string()},
                   {"-o", (folder / "lobe_residuals.png").string()}});
}

int runFitLobes(const CommandLine& line, const FitLobesOptions& options) {
  checkFitLobes(options);
  return LobeFitRun(line, options).run();
}

}  // namespace

void addFitLobesCommand(Command fit, CommandLine& line) {
  auto options = std::make_shared<FitLobesOptions>();
  Command command =
      fit.subcommand("lobes", "Lobes of multiple scattering, and the albedo of rough mirrors");
  command.option("-o,--output", options->folder, "Tables and pictures (results/latest)")
      .typeName("FOLDER");
  command.option("--data", options->data, "Where multiscatter.json goes (the output folder)")
      .typeName("FILE");
  command.option("--rays", options->rays, "Rays per roughness and incidence (2^21)");
  command.option("--mirror-rays", options->mirror_rays, "Rays per entry of the mirror (2^17)");
  command.option("--picture", options->picture, "Errors over roughness and incidence, sections")
      .typeName("FILE.png");
  command.footer(
      "Examples:\n"
      "  glintmark fit lobes --rays 100000 --mirror-rays 10000 --picture residuals.png\n"
      "  glintmark fit lobes --data data/multiscatter.json");
  command.callback([options, &line] {
    line.shares_work = true;
    line.opens_device = true;
    line.action = [options, &line] { return runFitLobes(line, *options); };
  });
}

}  // namespace glintmark
