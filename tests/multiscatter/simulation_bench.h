// Simulations on the device under test.
#pragma once
#include "host/harness/simulation_cases.h"
#include "host/simulate/simulation.h"
#include "tests/shared_bench.h"

namespace glintmark {

// Deviations of a count from its expectation are held to this many standard errors: beyond it lies
// a chance of 6e-7 per comparison.
inline constexpr double kDeviations = 5;

inline Simulation simulate(const SimulationSettings& settings, int lanes = 0) {
  KernelBench& bench = testBench();
  return Simulator(bench.device, bench.cache, lanes > 0 ? lanes : bench.device.info().default_lanes)
      .run(settings);
}

}  // namespace glintmark
