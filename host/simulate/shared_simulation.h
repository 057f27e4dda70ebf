// Simulations whose surfaces are dealt out to ranks.
#pragma once
#include <cstdint>
#include <vector>

#include "host/parallel/ranks.h"
#include "host/simulate/simulation.h"

namespace glintmark {

/// One simulation by all of `ranks`. Surface i is of the rank that makes() i, and counts add up to
/// the same whoever casts: the histogram is that of one rank. Ranks keep their counts to themselves
/// until collect(), since a histogram is 3 MB and a round may be short. Of all ranks: everything.
class SharedSimulation {
 public:
  /// Carries on with `simulation`, of which the first rank's counts; `simulator` and `ranks` must
  /// outlive it. Compiles.
  SharedSimulation(const Ranks& ranks, Simulator& simulator, const Simulation& simulation);

  bool isDone() const { return cast_ >= simulation_.settings.rays; }
  /// What ranks ask of each other between rounds.
  struct Wishes {
    bool stop = false, collect = false;
  };
  /// Casts at the next surfaces, as many at each rank as take about kRound_s, at least one; gives
  /// what some rank wishes.
  Wishes advance(const Wishes& mine);
  /// Brings the counts of all together.
  void collect();

  /// What has been collected; its histogram is whole at the first rank.
  const Simulation& collected() const { return simulation_; }
  /// Rays that have been cast by all, collected or not.
  std::uint64_t cast() const { return cast_; }
  /// Did this rank cast at the last surface?
  bool castLast() const;

  static constexpr double kRound_s = 0.25;

 private:
  const Ranks& ranks_;
  Simulator& simulator_;
  Simulation simulation_;
  std::vector<std::uint64_t> counts_;  // since the last collect()
  std::uint64_t cast_ = 0;
  std::uint64_t each_ = 1;  // surfaces of a rank in a round
};

/// Of all ranks: whole simulations, with their histograms at every rank. Surfaces of all of them
/// are dealt out at once. `stop` is called before each and may throw.
std::vector<Simulation> simulateShared(const Ranks& ranks, Simulator& simulator,
                                       const std::vector<SimulationSettings>& runs,
                                       const std::function<void()>& stop);

}  // namespace glintmark
