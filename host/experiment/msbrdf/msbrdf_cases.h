// Cases of table `msbrdf`: what each measures.
#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/experiment/bench_run.h"
#include "host/fit/lobe_fit.h"
#include "host/simulate/simulation.h"

namespace glintmark {

inline constexpr double kMsbrdfAlphas[] = {0.1, 0.24, 0.43, 0.62, 0.8, 1.0};
inline constexpr int kMsbrdfThetas_deg[] = {0, 30, 60, 80};
inline constexpr std::uint64_t kMsbrdfSurfaceRays = std::uint64_t{1} << 22;
inline constexpr std::uint64_t kMsbrdfModelRays = std::uint64_t{1} << 20;
inline constexpr double kConductorAlphas[] = {0.24, 0.43, 0.8};
inline constexpr int kConductorThetas_deg[] = {0, 45, 75};
inline constexpr std::uint64_t kConductorRays = std::uint64_t{1} << 19;  // a channel

/// Records of one case.
class MsbrdfCase {
 public:
  MsbrdfCase(BenchRun& run, const std::string& name) : run_(run), name_(name) {}
  void add(const std::string& metric, const std::vector<double>& samples, bool valid = true,
           const std::string& note = "");
  std::vector<Record> take() { return std::move(records_); }

 private:
  BenchRun& run_;
  std::string name_;
  std::vector<Record> records_;
};

SimulationSettings diffuseSettings(double alpha, double incidence_deg, int orders,
                                   std::uint64_t rays);

/// A model's energy per solid angle towards a cosine and azimuth, of facets of Beckmann roughness
/// `alpha`, at a cosine of incidence and the facets' albedo; the models of multiple scattering with
/// this project's coefficients, but for `published`.
std::function<double(double cosine, double azimuth)> diffuseEnergy(DiffuseModel model, double alpha,
                                                                   double mu_in, double albedo = 1);

/// surface/alpha=A: rate of the ray caster and energy per order.
std::vector<Record> measureSurface(BenchRun& run, const std::string& name);
/// model/alpha=A: errors of the models and their white furnace.
std::vector<Record> measureModel(BenchRun& run, const std::string& name);
/// energy/alpha=A/theta=T: energy per order, simulated and by each model.
std::vector<Record> measureEnergy(BenchRun& run, const std::string& name);
/// metal/alpha=A: white furnace of the kernels' specular lobe without and with compensation.
std::vector<Record> measureMetal(BenchRun& run, const std::string& name);
/// conductor/METAL/MODEL/alpha=A/theta=T: the ways of compensation against a coloured metal's
/// simulation; samples are channels.
std::vector<Record> measureConductor(BenchRun& run, const std::string& name);
/// all: cost.
std::vector<Record> measureMsbrdfCost(BenchRun& run);

/// Energy of orders 2 and 3 over roughness and incidence: models as lines, the records of
/// energy/... as dots. Writes kEnergyPicture and the same as SVG into the folder.
void writeEnergyChart(std::span<const Record> records, const std::filesystem::path& folder);
/// Rough clay in every model (rows) over roughness (columns).
Image sweepPicture(BenchRun& run);

}  // namespace glintmark
