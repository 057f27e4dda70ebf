#include "host/simulate/shared_simulation.h"

#include <algorithm>
#include <array>

#include "host/core/stopwatch.h"

namespace glintmark {

SharedSimulation::SharedSimulation(const Ranks& ranks, Simulator& simulator,
                                   const Simulation& simulation)
    : ranks_(ranks),
      simulator_(simulator),
      simulation_(simulation),
      counts_(HF_HISTOGRAM_WORDS, 0),
      cast_(simulation.rays_done) {
  simulation_.histogram.resize(HF_HISTOGRAM_WORDS);
  simulator_.prepare(simulation.settings);
}

SharedSimulation::Wishes SharedSimulation::advance(const Wishes& mine) {
  const SimulationSettings& settings = simulation_.settings;
  const std::uint64_t first = cast_ / kRaysPerSurface, all = surfaceCount(settings.rays);
  const std::uint64_t end =
      std::min(all, first + each_ * static_cast<std::uint64_t>(ranks_.size()));
  const Stopwatch watch;
  for (std::uint64_t i = first; i < end; ++i)
    if (ranks_.makes(i)) simulator_.castSurface(settings, i, counts_);
  cast_ = std::min(end * kRaysPerSurface, settings.rays);
  // Wishes, and the mean time of a round, from which all derive the same length of the next.
  std::array<std::uint64_t, 3> sums = {static_cast<std::uint64_t>(watch.elapsedNs()),
                                       mine.stop ? 1u : 0u, mine.collect ? 1u : 0u};
  ranks_.sum(sums);
  const double round_s = 1e-9 * static_cast<double>(sums[0]) / static_cast<double>(ranks_.size());
  const double surface_s = std::max(round_s / static_cast<double>(each_), 1e-6);
  each_ = static_cast<std::uint64_t>(std::max(1.0, kRound_s / surface_s));
  return {sums[1] > 0, sums[2] > 0};
}

void SharedSimulation::collect() {
  ranks_.sumAtFirst(counts_);
  for (std::size_t i = 0; i < counts_.size(); ++i) simulation_.histogram[i] += counts_[i];
  std::ranges::fill(counts_, 0);
  simulation_.rays_done = cast_;
}

bool SharedSimulation::castLast() const {
  return cast_ > 0 && ranks_.makes(surfaceCount(cast_) - 1);
}

std::vector<Simulation> simulateShared(const Ranks& ranks, Simulator& simulator,
                                       const std::vector<SimulationSettings>& runs,
                                       const std::function<void()>& stop) {
  RankDeal deal(ranks.size());
  std::vector<Simulation> whole;
  for (const SimulationSettings& settings : runs) {
    validate(settings);
    whole.push_back({settings, settings.rays, std::vector<std::uint64_t>(HF_HISTOGRAM_WORDS, 0)});
    for (std::uint64_t i = 0; i < surfaceCount(settings.rays); ++i) {
      const std::uint64_t rays = std::min(kRaysPerSurface, settings.rays - i * kRaysPerSurface);
      if (deal.next(static_cast<double>(rays)) != ranks.rank()) continue;
      stop();
      simulator.castSurface(settings, i, whole.back().histogram);
    }
  }
  for (Simulation& one : whole) ranks.sum(one.histogram);
  return whole;
}

}  // namespace glintmark
