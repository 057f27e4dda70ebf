// glintmark fit lobes: simulations over roughness and incidence, and what is fitted to them.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "host/cli/fit_commands.h"
#include "host/cli/interrupt.h"
#include "host/core/error.h"
#include "host/core/progress.h"
#include "host/core/stopwatch.h"
#include "host/fit/lobe_fit.h"
#include "host/fit/multiscatter_data.h"
#include "host/report/atomic_file.h"
#include "host/report/image_io.h"
#include "host/report/lobe_picture.h"
#include "host/report/text_table.h"

namespace glintmark {
namespace {

// [PAT18] names no grid; its figures are at 0.05 + 0.19 k. Every second value here is one of them.
constexpr int kAlphas = 11;
constexpr double kFirstAlpha = 0.05, kLastAlpha = 1;
constexpr double kIncidences_deg[] = {0, 10, 20, 30, 40, 50, 60, 70, 80, 85};
constexpr int kMirrorAlphas = 16, kMirrorMus = 16;
constexpr double kLeastMirrorMu = 0.02;  // 88.9 degrees

struct FitLobesOptions {
  std::string folder = "results/latest", data;
  double rays = 1 << 21, mirror_rays = 1 << 19;
};

struct FittedLobe {
  LobeData data;
  FreeLobe lobe;
};

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
  Simulation simulate(SimulationSettings settings, const std::string& what);
  void simulateDiffuse();
  void simulateMirror();
  std::string freeLobesCsv() const;
  std::string errorTable() const;
  void writePictures() const;

  const FitLobesOptions& options_;
  Device device_;
  ProgramCache cache_;
  Simulator simulator_;
  Progress progress_;
  int done_ = 0;
  std::vector<FittedLobe> lobes_;
  std::vector<LobeData> totals_;
  MultiscatterData result_;
};

Simulation LobeFitRun::simulate(SimulationSettings settings, const std::string& what) {
  if (InterruptGuard::interrupted()) throw Interrupted("interrupted; nothing is written");
  constexpr int kTotal =
      kAlphas * static_cast<int>(std::size(kIncidences_deg)) + kMirrorAlphas * kMirrorMus;
  progress_.show(done_++, kTotal, what);
  return simulator_.run(settings);
}

void LobeFitRun::simulateDiffuse() {
  for (int i = 0; i < kAlphas; ++i)
    for (const double incidence_deg : kIncidences_deg) {
      SimulationSettings s;
      s.alpha = glm::dvec2(kFirstAlpha + (kLastAlpha - kFirstAlpha) * i / (kAlphas - 1));
      s.incidence_deg = incidence_deg;
      s.rays = static_cast<std::uint64_t>(options_.rays);
      s.seed = static_cast<std::uint32_t>(done_ + 1);
      const Simulation simulation = simulate(s, "diffuse surfaces");
      for (int order = 1; order <= s.orders; ++order) {
        FittedLobe fitted{makeLobeData(simulation, order), {}};
        fitted.lobe = fitLobe(fitted.data);
        lobes_.push_back(std::move(fitted));
      }
      totals_.push_back(makeLobeData(simulation, 0));
    }
}

void LobeFitRun::simulateMirror() {
  MirrorAlbedo& table = result_.mirror;
  for (int j = 0; j < kMirrorMus; ++j)
    table.mus.push_back(kLeastMirrorMu + (1 - kLeastMirrorMu) * j / (kMirrorMus - 1));
  for (int i = 0; i < kMirrorAlphas; ++i) {
    table.alphas.push_back((i + 1.0) / kMirrorAlphas);
    for (const double mu : table.mus) {
      SimulationSettings s;
      s.kind = SurfaceKind::kMetal;
      s.index_n = 0.05;  // with k this large the Fresnel term is 1 to six digits
      s.index_k = 1000;
      s.alpha = glm::dvec2(table.alphas.back());
      s.incidence_deg = glm::degrees(std::acos(std::min(mu, 1.0)));
      s.orders = 1;
      s.rays = static_cast<std::uint64_t>(options_.mirror_rays);
      s.seed = static_cast<std::uint32_t>(done_ + 1);
      table.energy.push_back(orderEnergy(simulate(s, "mirrors"), 1));
    }
  }
}

std::string LobeFitRun::freeLobesCsv() const {
  std::string text = "alpha,mu,order,share,scale,exponent,flattening,deviation_rad,masking,error\n";
  for (const FittedLobe& f : lobes_)
    text += fmt::format("{:.4f},{:.6f},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                        f.data.alpha, f.data.mu_in, f.data.order, f.data.share, f.lobe.scale,
                        f.lobe.exponent, f.lobe.flattening, f.lobe.deviation_rad, f.lobe.masking,
                        f.lobe.error);
  return text;
}

// Mean over incidences of the error in order 2 of free lobes and of the sets of polynomials.
std::string LobeFitRun::errorTable() const {
  TextTable table({"alpha", "share of order 2", "free lobe", "code's fit", "text's fit", "refit",
                   "PAT18 code's share", "refit's share"});
  for (int i = 0; i < kAlphas; ++i) {
    double sums[7] = {};
    double alpha = 0;
    int count = 0;
    for (std::size_t k = 0; k < lobes_.size(); ++k) {
      const FittedLobe& f = lobes_[k];
      if (f.data.order != 2 || static_cast<int>(k / (std::size(kIncidences_deg) * 4)) != i)
        continue;
      alpha = f.data.alpha;
      const auto error = [&](const LobePolynomials& p) {
        const Lobe lobe = lobeAt(p, f.data.mu_in, alpha);
        return lobeError(f.data, [&](double cosine, double) {
          return lobeEnergy(lobe.scale, lobe.exponent, lobe.flattening, cosine);
        });
      };
      sums[0] += f.data.share;
      sums[1] += f.lobe.error;
      sums[2] += error(kPublishedCode);
      sums[3] += error(kPublishedText);
      sums[4] += error(result_.refit);
      sums[5] += lobeShare(lobeAt(kPublishedCode, f.data.mu_in, alpha));
      sums[6] += lobeShare(lobeAt(result_.refit, f.data.mu_in, alpha));
      ++count;
    }
    std::vector<std::string> row = {fmt::format("{:.3f}", alpha)};
    for (const double sum : sums) row.push_back(fmt::format("{:.4f}", sum / count));
    table.addRow(row);
  }
  return table.toString();
}

// Residuals of order 2: simulation, free lobe, refit, published, over roughness at 60 degrees.
void LobeFitRun::writePictures() const {
  std::vector<LobeDisc> discs;
  for (const FittedLobe& f : lobes_) {
    const bool shown =
        f.data.order == 2 && std::abs(f.data.mu_in - 0.5) < 1e-6 && f.data.alpha > 0.2;
    if (!shown) continue;
    const auto cell = [&f](double cosine, double azimuth) {
      const double folded = azimuth > std::numbers::pi ? 2 * std::numbers::pi - azimuth : azimuth;
      const int row =
          std::min(static_cast<int>((1 - cosine) * LobeData::kCosines), LobeData::kCosines - 1);
      const int column = std::min(static_cast<int>(folded / std::numbers::pi * LobeData::kAzimuths),
                                  LobeData::kAzimuths - 1);
      return f.data.energy[static_cast<std::size_t>(row * LobeData::kAzimuths + column)];
    };
    const double most = *std::ranges::max_element(f.data.energy);
    const auto residual = [&, most](const char* name, auto model) {
      discs.push_back({fmt::format("{} {:.3f}", name, f.data.alpha),
                       [cell, model](double cosine, double azimuth) {
                         return std::abs(model(cosine, azimuth) - cell(cosine, azimuth));
                       },
                       most});
    };
    discs.push_back({fmt::format("simulated {:.3f}", f.data.alpha), cell, most});
    residual("free", [&f](double cosine, double azimuth) {
      return freeLobeEnergy(f.lobe, f.data.alpha, f.data.mu_in, cosine, azimuth);
    });
    const auto polynomial = [&f](const LobePolynomials& p) {
      const Lobe lobe = lobeAt(p, f.data.mu_in, f.data.alpha);
      return [lobe](double cosine, double) {
        return lobeEnergy(lobe.scale, lobe.exponent, lobe.flattening, cosine);
      };
    };
    residual("refit", polynomial(result_.refit));
    residual("published", polynomial(kPublishedCode));
  }
  writePng(lobePicture(discs, 4), std::filesystem::path(options_.folder) / "lobe_residuals.png");
}

int LobeFitRun::run() {
  const std::filesystem::path folder = options_.folder;
  requireWritableFolder(folder);
  const std::filesystem::path data =
      options_.data.empty() ? folder / "multiscatter.json" : std::filesystem::path(options_.data);
  requireWritableFile(data);
  const InterruptGuard guard;
  const Stopwatch watch;
  simulateDiffuse();
  const double diffuse_s = watch.elapsedNs() * 1e-9;
  std::vector<LobeData> all;
  for (const FittedLobe& f : lobes_) all.push_back(f.data);
  const Stopwatch fit_watch;
  result_.refit = fitPolynomials(all);
  const double polynomials_s = fit_watch.elapsedNs() * 1e-9;
  simulateMirror();
  progress_.clear();
  result_.source = fmt::format(
      "glintmark fit lobes: {} rays each at {} roughnesses and {} incidences, mirror: {} rays each",
      options_.rays, kAlphas, std::size(kIncidences_deg), options_.mirror_rays);
  writeFile(data, toJson(result_));
  writeFile(folder / "free_lobes.csv", freeLobesCsv());
  const std::string table = errorTable();
  writeFile(folder / "lobe_errors.txt", table);
  writePictures();
  fmt::print("{}\nthird order over second: {:.4f} (published {:.4f})\n", table,
             result_.refit.third_order, kPublishedCode.third_order);
  fmt::print("simulations and lobes {:.1f} s, polynomials {:.2f} s, all {:.1f} s; written to {}\n",
             diffuse_s, polynomials_s, watch.elapsedNs() * 1e-9, data.string());
  return kExitDone;
}

int runFitLobes(const CommandLine& line, const FitLobesOptions& options) {
  for (const double rays : {options.rays, options.mirror_rays})
    if (!(rays >= 1000 && rays <= 1e12))
      throw Error(fmt::format("{} rays are not from 1000 to 1e12", rays));
  return LobeFitRun(line, options).run();
}

}  // namespace

void addFitLobesCommand(CLI::App& fit, CommandLine& line) {
  auto options = std::make_shared<FitLobesOptions>();
  CLI::App* command =
      fit.add_subcommand("lobes", "Lobes of multiple scattering, and the albedo of rough mirrors");
  command->add_option("-o,--output", options->folder, "Tables and pictures (results/latest)")
      ->type_name("FOLDER");
  command->add_option("--data", options->data, "Where multiscatter.json goes (the output folder)")
      ->type_name("FILE");
  command->add_option("--rays", options->rays, "Rays per roughness and incidence (2^21)");
  command->add_option("--mirror-rays", options->mirror_rays, "Rays per entry of the mirror (2^19)");
  command->footer("Example:\n  glintmark fit lobes --data data/multiscatter.json");
  command->callback(
      [options, &line] { line.action = [options, &line] { return runFitLobes(line, *options); }; });
}

}  // namespace glintmark
