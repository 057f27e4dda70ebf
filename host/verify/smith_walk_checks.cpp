// The walk among facets of Smith's theory: conservation, his formula for one bounce, reciprocity.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/harness/simulation_cases.h"
#include "host/harness/tolerances.h"
#include "host/reference/microfacet.h"
#include "host/simulate/simulation.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr std::uint64_t kWalks = std::uint64_t{1} << 19;

Simulation walk(const CheckContext& context, SimulationSettings settings) {
  settings.model = SurfaceModel::kSmith;
  settings.orders = HF_MAX_ORDERS;
  return Simulator(context.bench.device, context.bench.cache, context.lanes).run(settings);
}

SimulationSettings rough(double alpha, double incidence_deg, std::uint64_t rays) {
  SimulationSettings s;
  s.alpha = glm::dvec2(alpha);
  s.incidence_deg = incidence_deg;
  s.rays = rays;
  return s;
}

// Every ray is counted once; only metals absorb. Hard cases among them: straight on, along the
// surface, nearly smooth, anisotropic.
Finding everyRay(const CheckContext& context) {
  Finding finding(0);
  for (const SurfaceKind kind : {SurfaceKind::kDiffuse, SurfaceKind::kMetal})
    for (const glm::dvec2 alpha : {glm::dvec2(0.001), glm::dvec2(1), glm::dvec2(1, 0.001)})
      for (const double incidence_deg : {0.0, 60.0, 89.9}) {
        SimulationSettings s = rough(1, incidence_deg, 5001);
        s.kind = kind;
        s.alpha = alpha;
        s.azimuth_deg = 33;
        s.index_k = 3;
        const Simulation simulation = walk(context, s);
        finding.add(std::abs(simulation.balance() - 1));
        finding.require(simulation.rays_done == s.rays, "rays are missing");
        finding.require(simulation.gaveUp() == 0, "rays gave up");
        finding.require((simulation.absorbed() > 0) == (kind == SurfaceKind::kMetal),
                        "metals absorb, and nothing else does");
      }
  return finding;
}

Finding sameWalks(const CheckContext& context) {
  Finding finding(0);
  for (const SurfaceKind kind : {SurfaceKind::kDiffuse, SurfaceKind::kMetal}) {
    SimulationSettings s = rough(0.7, 50, 20000);
    s.kind = kind;
    s.index_k = 2;
    const Simulation one = walk(context.withLanes(1), s), wide = walk(context, s);
    double different = 0;
    for (std::size_t i = 0; i < one.histogram.size(); ++i)
      different += one.histogram[i] != wide.histogram[i];
    finding.add(different);
  }
  return finding;
}

// White facets give everything back, but for what is still on its way after the last order.
Finding white(const CheckContext& context) {
  Finding finding(kWhiteWalk);
  for (const double alpha : {0.2, 0.5, 0.8})
    for (const double incidence_deg : {0.0, 45.0, 85.0})
      for (const bool metal : {false, true}) {
        const Simulation simulation = walk(context, metal ? mirror(alpha, incidence_deg, kWalks)
                                                          : rough(alpha, incidence_deg, kWalks));
        double returned = 0;
        for (int order = 1; order <= int{HF_MAX_ORDERS}; ++order)
          returned += orderEnergy(simulation, order);
        finding.add(std::abs(returned - 1));
      }
  return finding;
}

// A mirror's energy of one bounce is that of Smith's formula, and so are its directions.
Finding oneBounce(const CheckContext& context) {
  Finding finding(kWalkEnergy);
  for (const double alpha : {0.2, 0.5, 1.0})
    for (const double incidence_deg : {0.0, 45.0, 75.0, 88.0})
      finding.add(
          std::abs(orderEnergy(walk(context, mirror(alpha, incidence_deg, kWalks)), 1) -
                   reference::microfacetAlbedo(reference::Ndf::kBeckmann,
                                               std::cos(glm::radians(incidence_deg)), alpha)));
  return finding;
}

constexpr std::size_t kBlockCosines = 8, kBlockAzimuths = 16;

// Half the sum of what blocks of cells have too much or too little of one bounce's energy.
Finding directions(const CheckContext& context) {
  Finding finding(kWalkDirections);
  constexpr double kCell_sr = 2 * std::numbers::pi / (HF_COSINES * HF_AZIMUTHS);
  for (const double incidence_deg : {20.0, 70.0}) {
    const SimulationSettings s = mirror(0.5, incidence_deg, kWalks);
    const Simulation simulation = walk(context, s);
    const glm::dvec3 view = incidentDirection(s);
    double distance = 0;
    for (std::size_t c = 0; c < HF_COSINES; c += kBlockCosines)
      for (std::size_t a = 0; a < HF_AZIMUTHS; a += kBlockAzimuths) {
        double excess = 0;
        for (std::size_t i = c; i < c + kBlockCosines; ++i)
          for (std::size_t j = a; j < a + kBlockAzimuths; ++j) {
            const double z = 1 - (static_cast<double>(i) + 0.5) / HF_COSINES;
            const double turn = 2 * std::numbers::pi * (static_cast<double>(j) + 0.5) / HF_AZIMUTHS;
            const double r = std::sqrt(1 - z * z);
            // What leaves along o is the BRDF times o's cosine: the reciprocal of what arrives.
            excess += static_cast<double>(simulation.cell(0, 1, i, j)) / double{kWalks} -
                      kCell_sr * reference::microfacetTimesCosine(
                                     reference::Ndf::kBeckmann,
                                     {r * std::cos(turn), r * std::sin(turn), z}, view, 0.5);
          }
        distance += std::abs(excess) / 2;
      }
    finding.add(distance);
  }
  return finding;
}

// Radiance over irradiance of an order towards a band of cosines about `cosine`.
double bandBrdf(const Simulation& simulation, int order, double cosine) {
  constexpr std::size_t kHalfBand = 5;
  const auto middle = static_cast<std::size_t>((1 - cosine) * HF_COSINES);
  double sum = 0;
  for (std::size_t c = middle - kHalfBand; c <= middle + kHalfBand; ++c)
    for (std::size_t a = 0; a < HF_AZIMUTHS; ++a)
      sum += static_cast<double>(simulation.cell(0, order, c, a)) /
             (1 - (static_cast<double>(c) + 0.5) / HF_COSINES);
  return sum;
}

// From 25 to 65 degrees as from 65 to 25, order by order.
Finding reciprocity(const CheckContext& context) {
  Finding finding(kWalkReciprocity);
  for (const bool metal : {false, true}) {
    const auto from = [&](double deg) {
      return walk(context, metal ? mirror(1, deg, kWalks) : rough(1, deg, kWalks));
    };
    const Simulation steep = from(25), low = from(65);
    for (int order = 1; order <= 2; ++order)
      finding.add(std::abs(bandBrdf(steep, order, std::cos(glm::radians(65.0))) /
                               bandBrdf(low, order, std::cos(glm::radians(25.0))) -
                           1));
  }
  return finding;
}

}  // namespace

std::vector<Check> smithWalkChecks() {
  return {{"smith_walk/every_ray", "everything counted over the rays - 1", everyRay},
          {"smith_walk/same_bits", "counts that differ from one lane's", sameWalks},
          {"smith_walk/white", "energy returned - 1", white},
          {"smith_walk/one_bounce", "energy against Smith's formula", oneBounce},
          {"smith_walk/directions", "energy in other directions", directions},
          {"smith_walk/reciprocity", "relative error", reciprocity}};
}

}  // namespace glintmark
