// Simulated scattering against a caster in double precision, Fresnel, Snell and Beckmann.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "host/experiment/msbrdf/lobe_picture.h"
#include "host/harness/reference_caster.h"
#include "tests/multiscatter/simulation_bench.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

// The same surface, other rays: shares of the rays that leave after one and after two bounces.
TEST(ScatteringPhysics, EnergiesAreThoseOfACasterInDoublePrecision) {
  KernelBench& bench = testBench();
  for (const double incidence_deg : {30.0, 75.0}) {
    constexpr double kAlpha = 0.8;
    constexpr int kReferenceRays = 100000;
    const SimulationSettings settings = mirror(kAlpha, incidence_deg, kRaysPerSurface);
    Simulator simulator(bench.device, bench.cache, bench.device.info().default_lanes);
    const Simulation simulation = simulator.run(settings);
    const ReferenceCaster caster(simulator.surface().readCounts(),
                                 kAlpha * simulator.surface().countHeight());
    // Not along an axis: turned by a trifle.
    glm::dvec3 direction = -incidentDirection(settings);
    direction.y = 1e-9;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> texel(0, HF_TILE);
    double left[3] = {};
    for (int i = 0; i < kReferenceRays; ++i) {
      const glm::dvec3 start(texel(random), texel(random), caster.top());
      const int count = caster.bounces(start, direction, 2);
      if (count <= 2) ++left[count];
    }
    EXPECT_EQ(left[0], 0);
    for (const int order : {1, 2}) {
      const double expected = left[order] / kReferenceRays;
      const double error = std::sqrt(expected * (1 - expected) / kReferenceRays);
      EXPECT_NEAR(orderEnergy(simulation, order), expected, kDeviations * error)
          << "order " << order << " at " << incidence_deg;
    }
  }
}

// Where hardly anything is hidden, single scattering is Beckmann's distribution seen from the side,
// direction by direction.
TEST(ScatteringPhysics, ObliqueLobeIsBeckmannsWithinCountingError) {
  constexpr double kAlpha = 0.15, kIncidence_deg = 45;
  constexpr std::size_t kRows = 32, kColumns = 32;
  std::vector<double> counted(kRows * kColumns), expected(kRows * kColumns);
  SimulationSettings s = mirror(kAlpha, kIncidence_deg, 1 << 12);
  s.orders = 1;
  Simulator simulator(testBench().device, testBench().cache,
                      testBench().device.info().default_lanes);
  double rays = 0;
  for (s.seed = 1; s.seed <= 64; ++s.seed) {
    const Simulation one = simulator.run(s);
    rays += static_cast<double>(one.rays_done);
    for (std::size_t row = 0; row < HF_COSINES; ++row)
      for (std::size_t column = 0; column < HF_AZIMUTHS; ++column)
        counted[row * kRows / HF_COSINES * kColumns + column * kColumns / HF_AZIMUTHS] +=
            static_cast<double>(one.cell(0, 1, row, column));
  }
  const glm::dvec3 i = incidentDirection(s);
  constexpr int kSteps = 3000;
  const double width = 10 * kAlpha / kSteps;
  for (int a = 0; a < kSteps; ++a)
    for (int b = 0; b < kSteps; ++b) {
      const double u = (a + 0.5) * width - 5 * kAlpha, v = (b + 0.5) * width - 5 * kAlpha;
      const double facing = i.z - u * i.x;
      const glm::dvec3 m = glm::normalize(glm::dvec3(-u, -v, 1));
      const glm::dvec3 o = 2 * glm::dot(i, m) * m - i;
      if (facing <= 0 || o.z <= 0) continue;
      const double turns = std::atan2(o.y, o.x) / (2 * std::numbers::pi);
      const auto row = static_cast<std::size_t>((1 - o.z) * kRows);
      const auto column = static_cast<std::size_t>((turns < 0 ? turns + 1 : turns) * kColumns);
      expected[row * kColumns + std::min(column, kColumns - 1)] +=
          rays * width * width * facing / i.z * std::exp(-(u * u + v * v) / (kAlpha * kAlpha)) /
          (std::numbers::pi * kAlpha * kAlpha);
    }
  double chi_sq = 0;
  int cells = 0;
  for (std::size_t cell = 0; cell < counted.size(); ++cell) {
    if (expected[cell] < 100) continue;
    chi_sq += std::pow(counted[cell] - expected[cell], 2) / expected[cell];
    ++cells;
  }
  EXPECT_GT(cells, 50);
  EXPECT_LT(chi_sq, cells + 2 * kDeviations * std::sqrt(2.0 * cells)) << cells << " cells";
}

// At normal incidence reflected rays leave in the azimuth of the slope, whose density is
// 1 / (2 pi ax ay (cos^2 / ax^2 + sin^2 / ay^2)).
TEST(ScatteringPhysics, AnisotropicAzimuthsFollowTheSlopes) {
  SimulationSettings s = mirror(0.3, 0, 1 << 12);
  s.alpha = {0.3, 0.1};
  s.orders = 1;
  s.last_bounce_leaves = true;
  constexpr std::size_t kBins = 32;
  double counted[kBins] = {}, rays = 0;
  Simulator simulator(testBench().device, testBench().cache,
                      testBench().device.info().default_lanes);
  for (s.seed = 1; s.seed <= 64; ++s.seed) {
    const Simulation one = simulator.run(s);
    rays += static_cast<double>(one.rays_done);
    for (std::size_t row = 0; row < HF_COSINES; ++row)
      for (std::size_t column = 0; column < HF_AZIMUTHS; ++column)
        counted[column * kBins / HF_AZIMUTHS] += static_cast<double>(one.cell(0, 1, row, column));
  }
  double chi_sq = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const auto below = [&](std::size_t edge) {  // the density's integral, from its arctangent
      const double phi = 2 * std::numbers::pi * static_cast<double>(edge) / kBins;
      const double turns =
          std::atan2(s.alpha.x * std::sin(phi), s.alpha.y * std::cos(phi)) / (2 * std::numbers::pi);
      return edge == kBins ? 1.0 : edge > kBins / 2 ? turns + 1 : turns;
    };
    const double expected = rays * (below(bin + 1) - below(bin));
    chi_sq += std::pow(counted[bin] - expected, 2) / expected;
  }
  EXPECT_LT(chi_sq, kBins + 2 * kDeviations * std::sqrt(2.0 * kBins));
}

// Turned by 90 degrees, an anisotropic surface is one with its roughnesses exchanged.
TEST(ScatteringPhysics, AnisotropyTurnsWithTheLight) {
  SimulationSettings along = mirror(0.2, 60, 1 << 19);
  along.alpha = {0.6, 0.2};
  SimulationSettings across = along;
  across.alpha = {0.2, 0.6};
  across.azimuth_deg = 90;
  across.seed = 2;
  for (const int order : {1, 2}) {
    const double a = orderEnergy(simulate(along), order), b = orderEnergy(simulate(across), order);
    // Of a surface's 7000 heights, not of its rays: hence one standard error of 7000 samples.
    EXPECT_NEAR(a, b, kDeviations * std::sqrt(2 * a * (1 - a) / 7000)) << order;
  }
}

double fresnel(double cosine, std::complex<double> index) {
  const std::complex<double> inside = std::sqrt(1.0 - (1 - cosine * cosine) / (index * index));
  return (std::norm((cosine - index * inside) / (cosine + index * inside)) +
          std::norm((index * cosine - inside) / (index * cosine + inside))) /
         2;
}

// Nearly smooth surfaces are mirrors and windows.
TEST(ScatteringPhysics, SmoothMetalReflectsAfterFresnel) {
  for (const double incidence_deg : {0.0, 50.0, 80.0}) {
    SimulationSettings s = mirror(0.001, incidence_deg, 200000);
    s.index_n = 0.2;
    s.index_k = 3.9;
    const Simulation simulation = simulate(s);
    const double cosine = std::cos(glm::radians(incidence_deg));
    const double expected = fresnel(cosine, {s.index_n, s.index_k});
    EXPECT_NEAR(orderEnergy(simulation, 1), expected,
                kDeviations * std::sqrt(expected * (1 - expected) / 200000.0))
        << incidence_deg;
    EXPECT_EQ(simulation.left(0, 1) + simulation.absorbed(), s.rays);
  }
}

TEST(ScatteringPhysics, SmoothDielectricFollowsFresnelAndSnell) {
  for (const double incidence_deg : {0.0, 50.0, 80.0}) {
    SimulationSettings s;
    s.kind = SurfaceKind::kDielectric;
    s.alpha = glm::dvec2(0.001);
    s.incidence_deg = incidence_deg;
    s.rays = 200000;
    const Simulation simulation = simulate(s);
    const double cosine = std::cos(glm::radians(incidence_deg));
    const double expected = fresnel(cosine, s.index_n);
    EXPECT_NEAR(orderEnergy(simulation, 1), expected,
                kDeviations * std::sqrt(expected * (1 - expected) / 200000.0))
        << incidence_deg;
    EXPECT_EQ(simulation.left(0, 1) + simulation.left(1, 1), s.rays);  // R + T = 1
    // Everything that goes through lies in the rows around Snell's angle, in the light's plane.
    const double below = std::sqrt(1 - (1 - cosine * cosine) / (s.index_n * s.index_n));
    const auto row = static_cast<std::size_t>((1 - below) * HF_COSINES);
    std::uint64_t there = 0;
    for (std::size_t i = row > 0 ? row - 1 : 0; i <= row + 1; ++i)
      for (std::size_t column = 0; column < HF_AZIMUTHS; ++column)
        if (incidence_deg == 0 || std::abs(static_cast<int>(column) - 128) <= 4)
          there += simulation.cell(1, 1, i, column);
    EXPECT_EQ(there, simulation.left(1, 1)) << incidence_deg;
  }
}

// Following rays further changes nothing in the orders before; what leaves later is what was left.
TEST(ScatteringPhysics, EveryOrderConservesEnergy) {
  for (const SurfaceKind kind :
       {SurfaceKind::kDiffuse, SurfaceKind::kMetal, SurfaceKind::kDielectric}) {
    SimulationSettings s;
    s.kind = kind;
    s.index_k = 2;
    s.rays = 100000;
    s.orders = HF_MAX_ORDERS;
    const Simulation whole = simulate(s);
    std::uint64_t gone = whole.gaveUp();
    for (int order = 1; order <= s.orders; ++order) {
      SimulationSettings shorter = s;
      shorter.orders = order;
      const Simulation part = simulate(shorter);
      for (int side = 0; side < 2; ++side)
        EXPECT_EQ(part.left(side, order), whole.left(side, order));
      gone += whole.left(0, order) + whole.left(1, order) +
              whole.histogram[HF_ABSORBED + static_cast<std::size_t>(order) - 1];
      EXPECT_EQ(part.leftOver() + gone, s.rays) << static_cast<int>(kind) << " order " << order;
    }
  }
}

// Cells that no ray meets, and no rays at all.
TEST(ScatteringPhysics, EmptyHistogramsAreDrawn) {
  SimulationSettings s = mirror(0.001, 0, 100);
  for (const Simulation& simulation :
       {simulate(s), Simulation{s, 0, std::vector<std::uint64_t>(HF_HISTOGRAM_WORDS)}}) {
    const Image picture = histogramPicture(simulation);
    EXPECT_TRUE(std::ranges::all_of(picture.pixels, [](float v) { return v >= 0 && v <= 1; }));
    EXPECT_EQ(simulation.balance(), 1);
    EXPECT_GE(orderEnergy(simulation, 2), 0);
  }
}

}  // namespace
}  // namespace glintmark
