// The ray caster against closed forms and conservation laws.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/core/error.h"
#include "host/simulate/simulation.h"
#include "host/simulate/simulation_file.h"
#include "host/simulate/surface_spectrum.h"
#include "tests/multiscatter/simulation_bench.h"

namespace glintmark {
namespace {

// Energies against Smith's theory, which takes heights to be independent of slopes and of each
// other; those of a smooth surface are not. Measured 0.021 at most over the cases below, at every
// resolution (docs/multiple_scattering.md); test_scattering_physics.cpp holds the caster to an
// exact reference.
constexpr double kSmithTolerance = 0.03;

std::string errorOf(SimulationSettings settings) {
  try {
    validate(settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Simulation, SlopesHaveTheNominalVariance) {
  Bench& bench = Bench::shared();
  for (const double length : {1.5, 3.0, 6.0}) {
    SurfaceMaker maker(bench.device, bench.cache, length);
    maker.draw(7);
    const SlopeMoments m = slopeMoments(maker.readCounts(), maker.countHeight());
    EXPECT_NEAR(m.variance_x, 0.5, 1e-5) << length;
    EXPECT_NEAR(m.variance_y, 0.5, 1e-5) << length;
    EXPECT_NEAR(m.covariance, 0, 1e-5) << length;
    EXPECT_NEAR(m.kurtosis_x, 3, 0.3) << length;
  }
}

// At normal incidence no facet hides another: first bounces follow Beckmann's distribution exactly.
// The reflected ray leaves at twice the facet's angle, and P(tan < t) = 1 - exp(-t^2 / alpha^2).
TEST(Simulation, FirstBounceIsBeckmannsWithinCountingError) {
  for (const double alpha : {0.05, 0.3, 0.8}) {
    // Few rays on each of many surfaces: a tile has some 7000 independent facets, and more rays
    // than that would measure the tile.
    SimulationSettings s = mirror(alpha, 0, 1 << 12);
    s.orders = 1;
    s.last_bounce_leaves = true;
    Simulation simulation{s, 0, std::vector<std::uint64_t>(HF_HISTOGRAM_WORDS)};
    Simulator simulator(Bench::shared().device, Bench::shared().cache,
                        Bench::shared().device.info().default_lanes);
    for (s.seed = 1; s.seed <= 64; ++s.seed) {
      const Simulation one = simulator.run(s);
      simulation.rays_done += one.rays_done;
      for (std::size_t i = 0; i < one.histogram.size(); ++i)
        simulation.histogram[i] += one.histogram[i];
    }
    double chi_sq = 0;
    int cells = 0;
    const auto below = [&](double cosine) {  // share of rays at angles up to that cosine's
      const double tangent_sq = (1 - cosine) / (1 + cosine);  // of half the angle
      return 1 - std::exp(-tangent_sq / (alpha * alpha));
    };
    for (std::size_t row = 0; row < HF_COSINES; row += 4) {
      double counted = 0;
      for (std::size_t i = row; i < row + 4; ++i)
        for (std::size_t column = 0; column < HF_AZIMUTHS; ++column)
          counted += static_cast<double>(simulation.cell(0, 1, i, column));
      const double n = static_cast<double>(simulation.rays_done);
      const double expected = n * (below(1 - (row + 4.0) / HF_COSINES) -
                                   below(1 - static_cast<double>(row) / HF_COSINES));
      if (expected < 100) continue;
      chi_sq += (counted - expected) * (counted - expected) / expected;
      ++cells;
    }
    // Mean and deviation of chi squared; the surfaces add a little to the counting error.
    EXPECT_LT(chi_sq, cells + 2 * kDeviations * std::sqrt(2.0 * cells)) << "alpha " << alpha;
  }
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

TEST(Simulation, SingleScatteringHasSmithsEnergy) {
  for (const double alpha : {0.2, 0.5, 0.8})
    for (const double incidence_deg : {0.0, 45.0, 75.0}) {
      const Simulation simulation = simulate(mirror(alpha, incidence_deg, 1 << 18));
      const double expected = smithSingleEnergy(alpha, incidence_deg);
      std::printf("alpha %.1f incidence %2.0f: %.4f, Smith %.4f\n", alpha, incidence_deg,
                  orderEnergy(simulation, 1), expected);
      EXPECT_NEAR(orderEnergy(simulation, 1), expected, kSmithTolerance);
    }
}

TEST(Simulation, CountsEveryRayOnce) {
  for (const SurfaceKind kind :
       {SurfaceKind::kDiffuse, SurfaceKind::kMetal, SurfaceKind::kDielectric}) {
    SimulationSettings s;
    s.kind = kind;
    s.index_k = 2;
    s.rays = 50001;
    const Simulation simulation = simulate(s);
    EXPECT_EQ(simulation.rays_done, s.rays);
    EXPECT_EQ(simulation.balance(), 1);
    EXPECT_EQ(simulation.gaveUp(), 0u);
    EXPECT_EQ(simulation.absorbed() > 0, kind == SurfaceKind::kMetal);
    std::uint64_t below = 0;
    for (int order = 1; order <= s.orders; ++order) below += simulation.left(1, order);
    EXPECT_EQ(below > 0, kind == SurfaceKind::kDielectric);
  }
}

TEST(Simulation, LanesDoNotMatter) {
  SimulationSettings s;
  s.rays = 20000;
  const Simulation reference = simulate(s, 1);
  for (const int lanes : {4, 8, 16}) EXPECT_EQ(simulate(s, lanes).histogram, reference.histogram);
}

TEST(Simulation, HardCases) {
  for (const double alpha : {0.001, 1.0})
    for (const double incidence_deg : {0.0, 89.9}) {
      SimulationSettings s;
      s.alpha = glm::dvec2(alpha);
      s.incidence_deg = incidence_deg;
      s.orders = 6;
      s.rays = 20000;
      const Simulation simulation = simulate(s);
      EXPECT_EQ(simulation.balance(), 1);
      EXPECT_EQ(simulation.gaveUp(), 0u) << alpha << " " << incidence_deg;
      EXPECT_EQ(orderEnergy(simulation, 1, 0), 0);  // albedo 0
      if (alpha < 0.01) {
        EXPECT_GT(orderEnergy(simulation, 1), 0.97);
      }
    }
}

// f(a -> b) = f(b -> a): the light that goes from one direction into a small cone around another,
// over the cosine of the latter, is the same both ways.
TEST(Simulation, HistogramsAreReciprocal) {
  constexpr std::uint64_t kRays = 1 << 21;
  constexpr double kFirst_deg = 20, kSecond_deg = 60;
  const auto towards = [&](double in_deg, double out_deg) {
    SimulationSettings s;
    s.alpha = glm::dvec2(0.8);
    s.incidence_deg = in_deg;
    s.rays = kRays;
    const Simulation simulation = simulate(s);
    // The direction's row and its neighbours, azimuths within 34 degrees of the light's.
    const auto row = static_cast<std::size_t>((1 - std::cos(glm::radians(out_deg))) * HF_COSINES);
    double count = 0;
    for (std::size_t i = row - 2; i <= row + 2; ++i)
      for (std::size_t column = 0; column < 24; ++column)
        for (int order = 1; order <= 4; ++order)
          count += static_cast<double>(simulation.cell(0, order, i, column) +
                                       simulation.cell(0, order, i, HF_AZIMUTHS - 1 - column));
    const double cosine = 1 - (static_cast<double>(row) + 0.5) / HF_COSINES;
    return std::pair(count / cosine, std::sqrt(count) / cosine);
  };
  const auto [there, there_error] = towards(kFirst_deg, kSecond_deg);
  const auto [back, back_error] = towards(kSecond_deg, kFirst_deg);
  // The cones are not points: 1 %.
  EXPECT_NEAR(there, back, kDeviations * std::hypot(there_error, back_error) + 0.01 * there);
}

TEST(Simulation, ErrorFallsWithTheRootOfTheRays) {
  const auto spread = [](std::uint64_t rays) {
    double sum = 0, squares = 0;
    constexpr int kRuns = 24;
    for (std::uint32_t seed = 1; seed <= kRuns; ++seed) {
      SimulationSettings s;
      s.rays = rays;
      s.seed = seed;
      const double energy = orderEnergy(simulate(s), 2);
      sum += energy;
      squares += energy * energy;
    }
    return std::sqrt(squares / kRuns - sum * sum / (kRuns * kRuns));
  };
  // Sixteen times the rays: a quarter of the spread, which 24 runs tell to 15 % each.
  const double ratio = spread(1000) / spread(16000);
  EXPECT_GT(ratio, 2);
  EXPECT_LT(ratio, 8);
}

TEST(Simulation, ResumesWhereItStopped) {
  SimulationSettings s;
  s.rays = kRaysPerSurface + 1000;
  Bench& bench = Bench::shared();
  Simulator simulator(bench.device, bench.cache, bench.device.info().default_lanes);
  Simulation half{s, 0, {}};
  simulator.advance(half);
  Simulation resumed = unpackSimulation(packSimulation(half), s, "file");
  while (resumed.rays_done < s.rays) simulator.advance(resumed);
  EXPECT_EQ(resumed.histogram, simulate(s).histogram);
}

TEST(Simulation, BadCheckpointsAreErrors) {
  SimulationSettings s;
  s.rays = 1000;
  const std::string text = packSimulation(simulate(s));
  SimulationSettings other = s;
  other.seed = 2;
  EXPECT_THROW(unpackSimulation(text, other, "file"), Error);
  EXPECT_THROW(unpackSimulation("nonsense", s, "file"), Error);
  EXPECT_THROW(unpackSimulation(text.substr(0, text.size() - 1), s, "file"), Error);
  std::string changed = text;
  changed[changed.size() - 8] ^= 1;
  EXPECT_THROW(unpackSimulation(changed, s, "file"), Error);
  other = s;
  other.rays = 999;
  EXPECT_THROW(unpackSimulation(text, other, "file"), Error);
}

TEST(Simulation, BadSettingsAreNamed) {
  SimulationSettings s;
  EXPECT_EQ(errorOf(s), "");
  s.alpha.x = 0;
  EXPECT_NE(errorOf(s).find("roughness along x 0"), std::string::npos) << errorOf(s);
  s = {};
  s.incidence_deg = 90;
  EXPECT_NE(errorOf(s).find("incidence"), std::string::npos);
  s = {};
  s.rays = 0;
  EXPECT_NE(errorOf(s).find("0 rays"), std::string::npos);
  s = {};
  s.orders = 7;
  EXPECT_NE(errorOf(s).find("orders"), std::string::npos);
  s = {};
  s.kind = SurfaceKind::kDielectric;
  s.index_n = 1;
  EXPECT_NE(errorOf(s).find("index of refraction"), std::string::npos);
  s.index_n = NAN;
  EXPECT_NE(errorOf(s), "");
  EXPECT_THROW(makeSurfaceSpectrum(0.5), Error);
}

}  // namespace
}  // namespace glintmark
