// Ways to give metals their energy back, against the same metals simulated.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/core/error.h"
#include "host/experiment/msbrdf/metal_models.h"
#include "host/experiment/msbrdf/msbrdf_cases.h"
#include "host/experiment/msbrdf/msbrdf_table.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

const Conductor& conductorOf(const std::string& name) {
  const auto found = std::ranges::find_if(
      conductors(), [&](const Conductor& metal) { return name == metal.name; });
  if (found == conductors().end()) throw Error(fmt::format("no metal {}", name));
  return *found;
}

SurfaceModel modelOf(const std::string& name) {
  if (name == kHeightsModel) return SurfaceModel::kHeights;
  if (name == kSmithModel) return SurfaceModel::kSmith;
  throw Error(fmt::format("no model {}", name));
}

// They take a while, and cases of a roughness follow one another.
const MetalModels& modelsAt(double alpha) {
  static std::map<double, MetalModels> known;
  return known.try_emplace(alpha, alpha).first->second;
}

}  // namespace

std::vector<Record> measureConductor(BenchRun& run, const std::string& name) {
  constexpr int kChannels = 3;
  const CaseName parts = CaseName::parse(name);
  const Conductor& metal = conductorOf(parts.word(1));
  const double alpha = parts.number(kAlphaKnob), theta_deg = parts.number(kThetaKnob);
  const MetalModels& models = modelsAt(alpha);
  Simulator simulator(run.device(), run.cache(), run.info().width);
  std::map<std::string, Samples> albedo_errors;
  std::map<std::string, double> lobe_squares;
  Samples albedos;
  bool valid = true;
  for (int channel = 0; channel < kChannels; ++channel) {
    stopIfInterrupted();
    const Simulation simulation = simulator.run(
        metalSettings(metal, channel, modelOf(parts.word(2)), alpha, theta_deg, kConductorRays));
    valid = valid && simulation.balance() == 1 && simulation.gaveUp() == 0;
    const LobeData data = makeLobeData(simulation, 0);
    const double f0 = metal.reflectance(channel);
    albedos.push_back(data.share);
    for (const auto& way : kCompensations) {
      const double albedo = models.albedo(way.model, f0, data.mu_in);
      albedo_errors[way.name].push_back(albedo / data.share - 1);
      const double lobe = models.lobeError(way.model, f0, data);
      lobe_squares[way.name] += lobe * lobe / kChannels;
    }
  }
  MsbrdfCase result(run, name);
  result.add("albedo_simulated", albedos, valid,
             valid ? "red, green and blue" : "not valid: the simulation lost or gave up rays");
  for (const auto& way : kCompensations) {
    result.add(fmt::format("albedo_error_{}", way.name), albedo_errors[way.name], valid,
               "albedo over the simulated one - 1, red, green and blue");
    result.add(fmt::format("lobe_error_{}", way.name), {std::sqrt(lobe_squares[way.name])}, valid,
               "root mean square of the lobe's difference over its mean, over channels");
  }
  return result.take();
}

}  // namespace glintmark
