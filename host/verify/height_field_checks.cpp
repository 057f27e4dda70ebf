// The ray caster against conservation laws and closed forms.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/harness/pixel_harness.h"
#include "host/harness/simulation_cases.h"
#include "host/harness/tolerances.h"
#include "host/simulate/simulation.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

Simulation simulate(const CheckContext& context, const SimulationSettings& settings) {
  return Simulator(context.bench.device, context.bench.cache, context.lanes).run(settings);
}

// What left, was absorbed, was left over or given up is every ray, once.
void addBalance(Finding& finding, const Simulation& simulation) {
  finding.add(std::abs(simulation.balance() - 1));
  finding.require(simulation.rays_done == simulation.settings.rays, "rays are missing");
  finding.require(simulation.gaveUp() == 0, fmt::format("{} rays gave up", simulation.gaveUp()));
}

Finding balance(const CheckContext& context) {
  Finding finding(0);
  for (const SurfaceKind kind :
       {SurfaceKind::kDiffuse, SurfaceKind::kMetal, SurfaceKind::kDielectric}) {
    SimulationSettings s;
    s.kind = kind;
    s.index_k = 2;
    s.rays = 50001;
    const Simulation simulation = simulate(context, s);
    addBalance(finding, simulation);
    finding.require((simulation.absorbed() > 0) == (kind == SurfaceKind::kMetal),
                    "metals absorb, and nothing else does");
    std::uint64_t below = 0;
    for (int order = 1; order <= s.orders; ++order) below += simulation.left(1, order);
    finding.require((below > 0) == (kind == SurfaceKind::kDielectric),
                    "dielectrics transmit, and nothing else does");
  }
  return finding;
}

// Smooth to rough and steep to grazing, every kind of surface; flat ones send everything back,
// black ones nothing.
Finding extremeSurfaces(const CheckContext& context) {
  Finding finding(0);
  for (const SurfaceKind kind :
       {SurfaceKind::kDiffuse, SurfaceKind::kMetal, SurfaceKind::kDielectric})
    for (const double alpha : {0.001, 0.03, 1.0})
      for (const double incidence_deg : {0.0, 60.0, 89.9}) {
        SimulationSettings s;
        s.kind = kind;
        s.alpha = glm::dvec2(alpha);
        s.incidence_deg = incidence_deg;
        s.index_k = 3;
        s.orders = HF_MAX_ORDERS;
        s.rays = 5000;
        const Simulation simulation = simulate(context, s);
        finding.add(std::abs(simulation.balance() - 1));
        finding.require(simulation.rays_done == s.rays, "rays are missing");
        finding.require(simulation.gaveUp() <= (kind == SurfaceKind::kDiffuse ? 0u : 1u),
                        fmt::format("{} of 5000 rays gave up", simulation.gaveUp()));
        finding.require(orderEnergy(simulation, 1, 0) == 0, "albedo 0 reflects");
        finding.require(
            kind != SurfaceKind::kDiffuse || alpha > 0.01 || orderEnergy(simulation, 1) > 0.97,
            "a flat surface hides light from itself");
      }
  return finding;
}

Finding sameCounts(const CheckContext& context) {
  SimulationSettings s;
  s.rays = 20000;
  const Simulation one = simulate(context.withLanes(1), s), wide = simulate(context, s);
  double different = 0;
  for (std::size_t i = 0; i < one.histogram.size(); ++i)
    different += one.histogram[i] != wide.histogram[i];
  Finding finding(0);
  finding.add(different);
  return finding;
}

Finding slopes(const CheckContext& context) {
  Finding finding(kSlopeVariance);
  for (const double length : {1.5, 3.0, 6.0}) {
    SurfaceMaker maker(context.bench.device, context.bench.cache, length);
    maker.draw(7);
    const SlopeMoments m = slopeMoments(maker.readCounts(), maker.countHeight());
    finding.add(std::abs(m.variance_x - 0.5));
    finding.add(std::abs(m.variance_y - 0.5));
    finding.add(std::abs(m.covariance));
    finding.require(std::abs(m.kurtosis_x - 3) < kSlopeKurtosis, "slopes are not Gaussian");
  }
  return finding;
}

// Energy of single scattering: [Heitz14], the mean over Beckmann's visible normals of Smith's
// masking towards the reflected direction.
double smithSingleEnergy(double alpha, double incidence_deg) {
  const auto lambda = [&](double z) {
    const double a = z / (alpha * std::sqrt(std::max(1 - z * z, 1e-14)));
    return std::erf(a) / 2 - 0.5 + std::exp(-a * a) / (2 * a * std::sqrt(std::numbers::pi));
  };
  const double theta = glm::radians(incidence_deg);
  const glm::dvec3 i(std::sin(theta), 0, std::cos(theta));
  constexpr int kSteps = 400;
  double sum = 0;
  const double reach = 4.5 * alpha;
  for (int a = 0; a < kSteps; ++a)
    for (int b = 0; b < kSteps; ++b) {
      const double u = reach * (2 * (a + 0.5) / kSteps - 1),
                   v = reach * (2 * (b + 0.5) / kSteps - 1);
      const double density =
          std::exp(-(u * u + v * v) / (alpha * alpha)) / (std::numbers::pi * alpha * alpha);
      const double facing = i.z - u * i.x;  // i . m over m . n
      if (facing <= 0) continue;
      const glm::dvec3 m = glm::normalize(glm::dvec3(-u, -v, 1));
      const glm::dvec3 o = 2 * glm::dot(i, m) * m - i;
      if (o.z <= 0) continue;
      sum += density * facing / i.z / (1 + lambda(i.z) + lambda(o.z));
    }
  return sum * std::pow(2 * reach / kSteps, 2);
}

Finding singleScattering(const CheckContext& context) {
  Finding finding(kSmithTolerance);
  for (const double alpha : {0.2, 0.5, 0.8})
    for (const double incidence_deg : {0.0, 45.0, 75.0})
      finding.add(
          std::abs(orderEnergy(simulate(context, mirror(alpha, incidence_deg, 1 << 18)), 1) -
                   smithSingleEnergy(alpha, incidence_deg)));
  return finding;
}

}  // namespace

std::vector<Check> heightFieldChecks() {
  return {{"height_field/balance", "everything counted over the rays - 1", balance},
          {"height_field/extremes", "everything counted over the rays - 1", extremeSurfaces},
          {"height_field/same_bits", "counts that differ from one lane's", sameCounts},
          {"height_field/slopes", "error of the slopes' variance", slopes},
          {"height_field/first_bounce", "energy against Smith's theory", singleScattering}};
}

}  // namespace glintmark
