// The ray caster against closed forms; conservation laws are checked by host/verify.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/core/error.h"
#include "host/simulate/simulation.h"
#include "host/simulate/simulation_file.h"
#include "host/simulate/surface_spectrum.h"
#include "tests/multiscatter/simulation_bench.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

std::string errorOf(SimulationSettings settings) {
  try {
    validate(settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
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
    Simulator simulator(testBench().device, testBench().cache,
                        testBench().device.info().default_lanes);
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
  KernelBench& bench = testBench();
  Simulator simulator(bench.device, bench.cache, bench.device.info().default_lanes);
  Simulation half{s, 0, {}};
  simulator.advance(half);
  Simulation resumed = unpackSimulation(packSimulation(half), s, "file");
  while (resumed.rays_done < s.rays) simulator.advance(resumed);
  EXPECT_EQ(resumed.histogram, simulate(s).histogram);
}

// One simulator for all: what was simulated before changes nothing.
TEST(Simulation, ModelsTakeTurns) {
  KernelBench& bench = testBench();
  Simulator simulator(bench.device, bench.cache, bench.device.info().default_lanes);
  SimulationSettings s;
  s.rays = 5000;
  simulator.run(s);
  s.model = SurfaceModel::kSmith;
  s.correlation_texels = 6;
  EXPECT_EQ(simulator.run(s).histogram, simulate(s).histogram);
  s.model = SurfaceModel::kHeights;
  EXPECT_EQ(simulator.run(s).histogram, simulate(s).histogram);
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
  s = {};
  s.f0 = 0.5;
  EXPECT_NE(errorOf(s).find("f0 is of metals"), std::string::npos);
  s.kind = SurfaceKind::kMetal;
  EXPECT_EQ(errorOf(s), "");
  s.tint = 2;
  EXPECT_NE(errorOf(s).find("tint 2 is out of range"), std::string::npos);
  s.tint = 0.5;
  s.f0.reset();
  EXPECT_NE(errorOf(s).find("a tint is of metals"), std::string::npos);
  EXPECT_THROW(makeSurfaceSpectrum(0.5), Error);
}

}  // namespace
}  // namespace glintmark
