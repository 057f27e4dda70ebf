// One device for the tests of simulations.
#pragma once
#include "host/harness/simulation_cases.h"
#include "host/simulate/simulation.h"

namespace glintmark {

// Deviations of a count from its expectation are held to this many standard errors: beyond it lies
// a chance of 6e-7 per comparison.
inline constexpr double kDeviations = 5;

struct Bench {
  Device device;
  ProgramCache cache{device};

  static Bench& shared() {
    static Bench bench;
    return bench;
  }
};

inline Simulation simulate(const SimulationSettings& settings, int lanes = 0) {
  Bench& bench = Bench::shared();
  return Simulator(bench.device, bench.cache, lanes > 0 ? lanes : bench.device.info().default_lanes)
      .run(settings);
}

}  // namespace glintmark
