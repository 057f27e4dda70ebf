// Rays that never leave are given up, also when no other ray of their work-item is left.
#include <gtest/gtest.h>

#include "host/simulate/simulation.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

TEST(StuckRay, IsGivenUp) {
  auto& [device, cache] = testBench();
  Simulator simulator(device, cache, 16);
  // Found by a fit of 2^19 rays an entry: one ray of this surface stays in its cell.
  SimulationSettings settings;
  settings.kind = SurfaceKind::kMetal;
  settings.index_n = 0.05;
  settings.index_k = 1000;
  settings.alpha = glm::dvec2(0.5);
  settings.incidence_deg = 75.23222405347063;
  settings.orders = 1;
  settings.rays = 1 << 19;
  settings.seed = 411;
  const Simulation simulation = simulator.run(settings);
  EXPECT_EQ(simulation.balance(), 1);
  EXPECT_LE(simulation.gaveUp(), 2u);
}

}  // namespace
}  // namespace glintmark
